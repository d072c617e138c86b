// A person on foot: falls, is stopped by rock, walks up slopes and steps, jumps. One kernel for the server
// and its clients, of + − × ÷ and sqrt alone: the same state, input and ground give the same bits. The same
// input gives the same walk, however it is divided into frames but for a tick.
//
// The body is an upright capsule, as spheres; places are of its feet. It never enters rock; where rock comes
// to the body (a fill, a merge), the body is pushed out, or rises. Loose pieces push, too, but give way to
// rock.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "shared/base/walking.h"

namespace scree {

/// What stands in a walker's way.
class WalkGround {
 public:
  /// Signed distance, metres, cut off somewhere beyond Walker::radius_m; and the unit direction away from
  /// what is near, zero where nothing tells.
  struct Touch {
    float distance_m = 0.0F;
    glm::vec3 away{0.0F};
  };

  virtual ~WalkGround() = default;
  virtual Touch rock(glm::vec3 place_m) = 0;
  virtual Touch loose(glm::vec3 place_m) = 0;
};

class Walker {
 public:
  static constexpr float radius_m = 0.3F;
  static constexpr float height_m = 1.7F;
  static constexpr float eye_above_m = 1.55F;
  static constexpr float step_m = 0.5F;        ///< up which one walks without a jump
  static constexpr float slope_cosine = 0.6F;  ///< 53 degrees: steeper ground does not carry
  static constexpr float skin_m = 0.02F;       ///< by which the body may overlap rock

  explicit Walker(glm::vec3 feet_m) { state_.feet_m = feet_m; }
  /// Goes on from there. Untrusted states pass is_walker_state() first.
  explicit Walker(const WalkerState& state) : state_(state) {}

  void step(const WalkInput& input, float elapsed_s, WalkGround& ground);

  /// As a step does first: where rock came to the body, it is pushed out, or rises.
  void leave_rock(WalkGround& ground);

  const WalkerState& state() const { return state_; }
  glm::vec3 feet_m() const { return state_.feet_m; }
  glm::vec3 eye_m() const { return state_.feet_m + glm::vec3(0.0F, eye_above_m, 0.0F); }
  bool stands() const { return state_.stands; }
  /// Whether rock held the body in the last step, so that it could not be pushed out and rose.
  bool was_held() const { return was_held_; }
  /// How deep a body there would be in rock, metres: 0 or less, none of it is.
  static float depth_m(glm::vec3 feet_m, WalkGround& ground);

 private:
  struct Settled {
    glm::vec3 feet_m{0.0F};
    bool carried = false;           ///< by ground that is not too steep
    std::optional<glm::vec3> wall;  ///< the last one that pushed, away from it
  };

  void tick(const WalkInput& input, WalkGround& ground);
  void speed_up(const WalkInput& input);
  bool move(glm::vec3 by_m, WalkGround& ground);
  bool step_up(glm::vec3 over_m, WalkGround& ground);
  void follow_down(WalkGround& ground);
  void come_out(WalkGround& ground);
  void note_wedged(glm::vec3 before_m);
  static bool is_free(glm::vec3 feet_m, WalkGround& ground);
  static Settled settle(glm::vec3 feet_m, WalkGround& ground);

  WalkerState state_;
  bool was_held_ = false;
};

/// Whether a walker can be in that state: its numbers are finite, and it is within the world.
bool is_walker_state(const WalkerState& state);
/// Whether a walker can be asked that: its numbers are finite, and it asks for no more than the full speed.
bool is_walk_input(const WalkInput& input);

}  // namespace scree
