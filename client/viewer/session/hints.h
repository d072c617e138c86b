// The one line of advice that a newcomer reads: what to do next, until it was done or had its time. No clock:
// time is an argument, in seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "client/viewer/input/tool.h"

namespace scree {

class Hints {
 public:
  /// The person has used a tool.
  void note(ToolUse use) { ++used_[static_cast<size_t>(use)]; }
  /// Whether any tool was used: before, a program tells how its own hands work.
  bool has_begun() const { return used_ != Counts{}; }
  /// What to try next; empty: nothing any more. `rewinds`: there is a recording to look back at.
  std::string_view text(bool carries, bool rewinds, double now_s);

 private:
  using Counts = std::array<uint32_t, kind_count<ToolUse>>;

  Counts used_{};
  size_t next_ = 0;  ///< the one that is shown, or waits
  std::optional<double> shown_since_s_;
};

}  // namespace scree
