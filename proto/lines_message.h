// What administrators may read of a server line by line (proto/access.proto). Values.
#pragma once

#include <cstdint>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

enum class LinesOf : uint8_t { audit = 0, log = 1, figures = 2, settings = 3 };

struct LinesOfRow {
  std::string_view name;
};

constexpr LinesOfRow row_of(LinesOf of) {
  switch (of) {
    case LinesOf::audit:  // what administrators did
      return {"audit"};
    case LinesOf::log:  // what the server's log says
      return {"log"};
    case LinesOf::figures:  // of the last hour
      return {"figures"};
    case LinesOf::settings:  // with their bounds and help
      return {"settings"};
  }
  return {};
}

/// Answered by an AdminListMessage whose text is lines of JSON.
struct ListLinesRequest {
  LinesOf of = LinesOf::audit;
  uint32_t most = 0;  ///< the newest so many; 0: all that a message holds
};

}  // namespace scree
