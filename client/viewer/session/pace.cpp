#include "client/viewer/session/pace.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

void Pace::start(double tick_rate_hz) {
  CHECK(tick_rate_hz > 0.0);
  *this = {};
  rate_hz_ = tick_rate_hz;
}

void Pace::note(Tick tick, double now_s) {
  const bool first = arrivals_.empty();
  if (!first && tick <= arrivals_.back().tick) return;
  if (first) begun_s_ = now_s;
  arrivals_.push_back({now_s, tick, now_s - static_cast<double>(tick) / rate_hz_});
  while (arrivals_.size() > 2 && arrivals_[1].at_s <= now_s - window_s) arrivals_.pop_front();
  if (now_s - begun_s_ <= window_s) least_late_at_first_s_ = least_late_s();
}

double Pace::factor() const {
  if (arrivals_.size() < 2) return 1.0;
  const double elapsed_s = arrivals_.back().at_s - arrivals_.front().at_s;
  if (elapsed_s < window_s * 0.5) return 1.0;
  return static_cast<double>(arrivals_.back().tick - arrivals_.front().tick) / (elapsed_s * rate_hz_);
}

uint64_t Pace::lost_ticks() const {
  if (arrivals_.empty()) return 0;
  const double lost = (least_late_s() - least_late_at_first_s_) * rate_hz_;
  return lost >= 1.0 ? static_cast<uint64_t>(std::floor(lost)) : 0;
}

double Pace::least_late_s() const {
  const auto least = std::ranges::min_element(arrivals_, {}, &Arrival::late_s);
  return least == arrivals_.end() ? 0.0 : least->late_s;
}

}  // namespace scree
