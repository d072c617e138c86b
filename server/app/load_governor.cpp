#include "server/app/load_governor.h"

#include <algorithm>
#include <numeric>

#include "server/work/limits.h"
#include "shared/base/check.h"

namespace scree {

LoadGovernor::LoadGovernor(uint32_t tick_rate_hz, uint32_t most)
    : ticks_per_interval_(std::max(2U, static_cast<uint32_t>(limits::governor_interval_s * tick_rate_hz))),
      most_(most) {
  CHECK(most >= limits::work_percent_min && most <= limits::work_percent_max);
}

std::optional<uint32_t> LoadGovernor::tick_ended(double length, uint64_t lost, uint32_t percent) {
  CHECK(percent >= limits::work_percent_min && percent <= limits::work_percent_max);
  ++ticks_;
  late_ += length > 1.0 ? 1 : 0;
  losses_.back() += lost > 0 ? 1 : 0;
  if (ticks_ < ticks_per_interval_) return std::nullopt;
  const uint32_t wanted = wanted_after_interval(percent);
  return wanted == percent ? std::nullopt : std::optional(wanted);
}

uint32_t LoadGovernor::wanted_after_interval(uint32_t percent) {
  const bool calm = losses_.back() == 0 && late_ <= limits::governor_late_share * ticks_;
  calm_intervals_ = calm ? calm_intervals_ + 1 : 0;
  const bool behind = std::accumulate(losses_.begin(), losses_.end(), 0U) >= limits::governor_losses_min;
  std::rotate(losses_.begin(), losses_.begin() + 1, losses_.end());
  losses_.back() = ticks_ = late_ = 0;
  if (behind) {
    losses_.fill(0);
    return std::max(limits::work_percent_min, percent * limits::governor_lower_percent / 100);
  }
  if (calm_intervals_ < limits::governor_calm_intervals) return percent;
  calm_intervals_ = 0;
  return std::max(percent, std::min(most_, percent + limits::governor_raise_percent));
}

}  // namespace scree
