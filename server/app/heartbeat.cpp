#include "server/app/heartbeat.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/app/limits.h"

namespace scree {

std::optional<std::string> Heartbeat::check(double now_s) {
  const double silent = silent_s(now_s);
  if (!stands_still(now_s)) {
    if (told_s_ == 0.0) return std::nullopt;
    told_s_ = 0.0;
    return fmt::format("the simulation goes on, after {:.1f} s in which no tick ended", worst_s_);
  }
  worst_s_ = silent;
  if (told_s_ != 0.0 && silent - told_s_ < limits::still_line_seconds) return std::nullopt;
  told_s_ = silent;
  return fmt::format("the simulation stands still: no tick has ended for {:.1f} s", silent);
}

}  // namespace scree
