// Raymarched frames of several carved grounds, drawn in turns.
#pragma once

#include <memory>
#include <vector>

#include "bench/support/drawing.h"
#include "studies/scale/axis.h"

namespace scree {

/// How far the drawings see, metres.
inline constexpr float frame_view_radius_m = 96.0F;

class FrameSet {
 public:
  explicit FrameSet(Stage& stage);

  /// A drawing of the ground after so many carves of that radius, all within 40 m of the origin. The picture
  /// is the same for any number of carves from a hundred on (Drawing::carved_places).
  Result<void> add(double size, const TerrainSource& terrain, int carves, float radius_m);

  /// Adds the time of a frame of each drawing to the axis's curves, in so many rounds.
  Result<void> measure(Axis& axis, int rounds);
  /// The curve that tells most of what a frame costs: the processor time of all threads where software draws,
  /// else the time until the GPU has finished.
  Curve& curve(Axis& axis) const;

 private:
  struct Sized {
    double size;
    std::unique_ptr<Drawing> drawing;
  };

  Stage& stage_;
  bool software_;  ///< draws
  std::vector<Sized> drawings_;
};

}  // namespace scree
