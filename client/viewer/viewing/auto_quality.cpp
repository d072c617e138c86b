#include "client/viewer/viewing/auto_quality.h"

#include <algorithm>

namespace scree {

std::optional<Quality> AutoQuality::note(float frame_ms, bool loaded) {
  if (decided_) return std::nullopt;
  if (loaded != were_loaded_) times_ms_.clear();
  were_loaded_ = loaded;
  times_ms_.push_back(frame_ms);
  if (times_ms_.size() < frames) return std::nullopt;
  std::ranges::nth_element(times_ms_, times_ms_.begin() + frames / 2);
  const float median_ms = times_ms_[frames / 2];
  times_ms_.clear();
  if (!loaded) {
    if (quality_ == Quality::low || median_ms <= slow_loading_ms) return std::nullopt;
    return change(Quality::low, true);
  }
  if (quality_ == Quality::medium && median_ms <= quick_ms) return change(Quality::high, false);
  if (quality_ == Quality::medium && median_ms > slow_ms) return change(Quality::low, true);
  if (quality_ == Quality::high && median_ms > 2.0F * quick_ms) return change(Quality::medium, true);
  decided_ = true;
  return std::nullopt;
}

std::optional<Quality> AutoQuality::change(Quality quality, bool decided) {
  quality_ = quality;
  decided_ = decided;
  were_loaded_ = false;
  return quality;
}

}  // namespace scree
