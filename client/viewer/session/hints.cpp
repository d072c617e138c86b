#include "client/viewer/session/hints.h"

#include <array>

namespace scree {
namespace {

/// Seconds for which a line is shown that nobody follows: then the next one has its turn.
constexpr double shown_s = 40.0;

struct Hint {
  std::optional<ToolUse> done_by;  ///< using this tool; nothing: it has its time
  uint32_t times = 1;              ///< so often
  std::string_view words;
};

/// What is best here comes first.
constexpr std::array hints{
    Hint{ToolUse::carve, 4, "3: carve. Strike an arch, a pillar or a tower at its feet, and it topples"},
    Hint{std::nullopt, 0, "J: rewind, and see it fall again from any side"},
    Hint{ToolUse::place, 1, "2: place what you carry, where you look"},
};

}  // namespace

std::string_view Hints::text(bool carries, bool rewinds, double now_s) {
  if (!has_begun()) return {};
  const auto is_over = [&](const Hint& hint) {
    const bool done = hint.done_by && used_[static_cast<size_t>(*hint.done_by)] >= hint.times;
    if (done || (!hint.done_by && !rewinds)) return true;
    return shown_since_s_ && now_s > *shown_since_s_ + shown_s;
  };
  while (next_ < hints.size() && is_over(hints[next_])) {
    ++next_;
    shown_since_s_.reset();
  }
  if (next_ == hints.size()) return {};
  const Hint& hint = hints[next_];
  if (hint.done_by == ToolUse::place && !carries) return {};
  if (!shown_since_s_) shown_since_s_ = now_s;
  return hint.words;
}

}  // namespace scree
