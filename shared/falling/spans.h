// Finds terrain that breaks though it is held at several places: beams with two ends, decks on piers, plates,
// arches. It looks along thin terrain as far as it goes (span_bodies.h), not only around the change.
//
// The terrain is a frame of rigid bodies with elastic joints (span_joints.h). By the safe theorem of limit
// analysis it stands if any state in equilibrium strains no section beyond its strength. States are tried by
// softening the joints that are strained most (Mackenzie and Boyle 1993). Rock is brittle: where all joints
// of one plane section are at their limit, it is cracked through, and from then on bears only the bending
// that its pressure can balance. So a clamped beam breaks when w L²/12 cracks its ends, because the middle
// does not bear w L²/8 then. A plate that is cracked in part, or along a wide section, hands on its load, as
// yield lines do. An arch
// stands while a thrust line fits in. A flat beam gets no thrust: what would push it apart is not known.
//
// Deterministic, the same bits everywhere. Lengths in voxels.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/falling/holding.h"
#include "shared/falling/overload.h"
#include "shared/field/field.h"
#include "shared/material/palette.h"

namespace scree {

struct SpansFound {
  std::vector<Overload> overloads;
  size_t bodies = 0;  ///< of the frame
  size_t joints = 0;
  size_t bricks_read = 0;  ///< as joints, a measure of the cost; with the products of blocks in all solutions
  size_t products = 0;
  double strain = 0.0;  ///< greatest tension of the elastic state over what its section bears
};

/// A force besides weight, at a place, and a voxel of rock on which it falls.
struct SpanForce {
  VoxelCoord on;
  glm::dvec3 at{0.0};
  glm::dvec3 newtons{0.0};
};

/// Parts of one frame: farther ones hold. A plate of 12 × 12 bricks, or a beam of 150.
inline constexpr size_t span_parts_max = 160;
/// The same under a blow, which is to cost less: a plate of 6 × 6 bricks.
inline constexpr size_t struck_parts_max = 40;

/// One frame, on which several forces may be tried: to make it costs as much as some of them. Not
/// thread-safe.
class SpanSearch {
 public:
  /// What connects to these bricks, or to bricks beside them. `field` and `palette` must outlive this.
  /// `holding`: as of find_spans().
  SpanSearch(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
             size_t parts_max, const Holding* holding = nullptr);
  ~SpanSearch();
  SpanSearch(const SpanSearch&) = delete;
  SpanSearch& operator=(const SpanSearch&) = delete;

  /// `force`: null where weight is all. Independent of what was tried before.
  SpansFound run(const SpanForce* force);

 private:
  class Frame;
  std::unique_ptr<Frame> frame_;
};

/// By weight alone. `holding`: what it holds holds the rest, as ground does; null: nothing.
SpansFound find_spans(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                      const Holding* holding = nullptr);

}  // namespace scree
