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

/// What becomes of what one carries when the session ends, for who is about to end it; empty: nothing that
/// needs words. A token's store waits for its next session (docs/digging.md).
constexpr std::string_view words_before_the_end(bool carries, bool has_token) {
  if (!carries || has_token) return {};
  return "What you carry goes to the world's store when you end. With an access token it would wait for you.";
}

}  // namespace scree
