// Limits the lines of a log: a few a second of each kind, so that nobody can fill a disk by causing them.
// What is left out is counted and told with the next line of its kind. Time is an argument (seconds). Not
// thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "shared/base/limits.h"
#include "shared/base/rate_limit.h"

namespace scree {

class LogLimit {
 public:
  /// What to append to a line of this kind; nothing: leave the line out. The caller's kinds are few and
  /// fixed.
  std::optional<std::string> admit(std::string_view kind, double now_s) {
    const auto found =
        kinds_
            .try_emplace(std::string(kind),
                         Kind{RateLimit(limits::log_lines_per_second, limits::log_lines_burst)})
            .first;
    if (!found->second.rate.try_spend(now_s)) {
      ++found->second.left_out;
      return std::nullopt;
    }
    const uint64_t left_out = std::exchange(found->second.left_out, 0);
    if (left_out == 0) return std::string();
    return " (and " + std::to_string(left_out) + " more like this)";
  }

 private:
  struct Kind {
    RateLimit rate;
    uint64_t left_out = 0;
  };
  std::map<std::string, Kind> kinds_;
};

}  // namespace scree
