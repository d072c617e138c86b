// The motions of all pieces and props, one for all clients: predicted as every client predicts them, and
// corrected when the prediction leaves the piece. Not thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "proto/motion.h"
#include "server/world/published_state.h"

namespace scree {

/// Where a piece is and how it came there, as published.
struct MotionTarget {
  QuantisedPose pose;
  Motion at;                 ///< at rest there
  glm::ivec3 moved{0};       ///< in the last step
  uint32_t still_steps = 0;  ///< in which the pose did not change
  uint32_t steps = 0;        ///< in which it was followed: in the first, it comes from nowhere
};

/// The correction that the motion needs in this step, if it needs any. After it, a piece that rests or whose
/// step is 1/60 s is within 1.2 mm and 0.26° of its target; in longer steps a piece that moves may be farther
/// off (motion_position_coarser). Only turns of more than 150° in a step take several.
std::optional<Correction> correction_of(const Motion& motion, const MotionTarget& target,
                                        const MotionRules& rules);

struct TrackedMotion {
  // What every client asks of every piece comes first, on one line of the cache.
  PieceId id = 0;
  bool alive = true;                     ///< for the walk of track()
  glm::vec3 place_m{0.0F};               ///< as published
  Tick changed = 0;                      ///< last tick in which it moved, was corrected or was made
  Motion before;                         ///< the last step
  Motion motion;                         ///< after it
  uint32_t before_check = 0;             ///< motion_check() of that before
  uint32_t check = 0;                    ///< and of that after
  std::optional<Correction> correction;  ///< in it
  MotionTarget target;
  glm::vec3 centre_m{0.0F};  ///< of the volume, in its own frame; of a prop 0
};

class Motions {
 public:
  Motions(const MotionRules& rules, float voxel_size_m) : rules_(rules), voxel_size_m_(voxel_size_m) {}

  /// Follows a tick; `state` is that after it. `step`: it is one whose frames have poses.
  void track(const TickDelta& delta, const PublishedState& state, bool step);

  /// Every piece and every prop, ordered by id.
  const std::vector<TrackedMotion>& all() const { return pieces_; }
  /// The tick of the last step, and of the one before it; 0: none.
  Tick stepped() const { return stepped_; }
  Tick stepped_before() const { return stepped_before_; }

 private:
  TrackedMotion* find(PieceId id);
  void make(PieceId id, glm::vec3 centre_m, std::optional<PieceId> parent, Tick tick);
  /// Takes one to where it is now.
  void follow(TrackedMotion& one, const QuantisedPose& pose, bool step, Tick tick) const;
  void advance(TrackedMotion& piece, Tick tick) const;

  MotionRules rules_;
  float voxel_size_m_;
  std::vector<TrackedMotion> pieces_;
  Tick stepped_ = 0, stepped_before_ = 0;
};

}  // namespace scree
