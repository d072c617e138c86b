#include "client/viewer/synthesis/limiter.h"

#include <algorithm>

namespace scree {
namespace {

/// Part of what is missing that comes back in a sample: two thirds in 0.15 s at 48 kHz.
constexpr float release = 1.0F / 7200.0F;

float size_of(float sample) {
  return sample < 0.0F ? -sample : sample;
}

}  // namespace

float Limiter::least_with(float gain) {
  while (count_ > 0 && wanted_[first_].at + window <= now_) {
    first_ = (first_ + 1) % window;
    --count_;
  }
  while (count_ > 0 && wanted_[(first_ + count_ - 1) % window].gain >= gain) --count_;
  wanted_[(first_ + count_) % window] = {gain, now_};
  ++count_;
  return wanted_[first_].gain;
}

float Limiter::mean_with(float gain) {
  const size_t place = now_ % window;
  sum_ += gain - gains_[place];
  gains_[place] = gain;
  if (place == 0) {  // or roundings would add up
    sum_ = 0.0F;
    for (const float one : gains_) sum_ += one;
  }
  return sum_ / static_cast<float>(window);
}

void Limiter::limit(float* samples, size_t frames) {
  for (size_t i = 0; i < frames; ++i, ++now_) {
    float* const sample = samples + 2 * i;
    const float peak = std::max(size_of(sample[0]), size_of(sample[1]));
    const float least = least_with(peak > peak_max ? peak_max / peak : 1.0F);
    released_ = std::min(least, released_ + release * (1.0F - released_));
    const float gain = mean_with(released_);
    float* const waiting = waiting_.data() + 2 * (now_ % window);
    // The oldest of the window comes out as the newest goes in.
    const float* const oldest = waiting_.data() + 2 * ((now_ + 1) % window);
    for (size_t side = 0; side < 2; ++side) {
      waiting[side] = sample[side];
      sample[side] = std::clamp(oldest[side] * gain, -peak_max, peak_max);
    }
  }
}

}  // namespace scree
