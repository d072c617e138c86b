// Chooses a preset by how long the first frames take. No window, no clock.
#pragma once

#include <optional>
#include <vector>

#include "client/render/scene/quality.h"

namespace scree {

class AutoQuality {
 public:
  static constexpr Quality first = Quality::medium;
  /// Frames that decide, by their median.
  static constexpr size_t frames = 12;
  /// A median frame over the first, milliseconds, is too slow: a preset lower. Up to the second there is time
  /// for more.
  static constexpr float slow_ms = 80.0F;
  static constexpr float quick_ms = 20.0F;
  /// Loading, when little is drawn: over this, it would be slower still.
  static constexpr float slow_loading_ms = 160.0F;

  /// The time of a frame drawn by the preset, and whether the world stood in it. The preset to draw by from
  /// now on, when it is another one.
  std::optional<Quality> note(float frame_ms, bool loaded);
  Quality quality() const { return quality_; }

 private:
  std::optional<Quality> change(Quality quality, bool decided);

  Quality quality_ = first;
  bool decided_ = false;
  bool were_loaded_ = false;  ///< the frames so far
  std::vector<float> times_ms_;
};

}  // namespace scree
