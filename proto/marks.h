// The events of a replay's recording as a bar shows them: counted by kind in columns of equal time, so that
// they take the same room however long the recording is.
#pragma once

#include <cstdint>
#include <vector>

#include "proto/event.h"
#include "shared/base/ids.h"

namespace scree {

namespace limits {
/// Columns of a replay's marks: more than one for two pixels of a wide screen's bar. A longer recording has
/// longer columns.
inline constexpr uint32_t mark_columns_max = 1024;

/// Events of one kind that one column counts; above: as many are told.
inline constexpr uint32_t mark_count_max = 65535;
}  // namespace limits

/// Events of one kind in one column.
struct Mark {
  EventKind kind{};
  uint32_t column = 0;  ///< below limits::mark_columns_max
  uint32_t count = 0;   ///< 1 to limits::mark_count_max

  bool operator==(const Mark&) const = default;
};

struct MarksMessage {
  Tick first = 0;             ///< column 0 begins after this tick
  Tick ticks_per_column = 1;  ///< never 0
  uint32_t from = 0;          ///< the first column that is told: those before it are as they were told before
  Tick read_to = 0;           ///< up to here the recording has been looked through
  std::vector<Mark> marks{};  ///< ordered by kind, then by column

  bool operator==(const MarksMessage&) const = default;
};

/// What somebody who has `known` needs in order to have `now`, which tells all columns.
MarksMessage news_since(const MarksMessage& known, const MarksMessage& now);

/// Puts the news over what is known. News that do not fit change nothing.
void apply_news(MarksMessage& known, const MarksMessage& news);

}  // namespace scree
