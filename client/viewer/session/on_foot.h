// Walking instead of flying: carries a camera on a walker's shoulders.
#pragma once

#include <optional>

#include "client/render/scene/draw_method.h"
#include "client/viewer/input/fly_camera.h"
#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"

namespace scree {

/// The input of a person who looks so; upwards is a jump.
WalkInput walk_input_of(const Camera& camera, const FlyInput& input);
/// Turns the camera alone.
void turn_by(Camera& camera, const FlyInput& input, float elapsed_s);
/// Puts the camera there; `steps`: over a step or a slope, without a jolt.
void carry(Camera& camera, glm::vec3 eye_m, bool steps, float elapsed_s);

/// What stands in a walker's way about that place. It holds as long as the scene stays as it is.
SolidGround ground_of_scene(const Scene& scene, glm::vec3 about_m);

class OnFoot {
 public:
  bool walks() const { return walker_.has_value(); }
  /// Only while it walks.
  glm::vec3 feet_m() const { return walker_->feet_m(); }
  /// Begins to walk where the camera is, or flies on from there.
  void change(const Camera& camera);
  /// Flies, as in another world, until change().
  void stop() { walker_.reset(); }

  /// Turns the camera, and moves it as far as the scene lets it go; input upwards is a jump. Only while it
  /// walks.
  void step(Camera& camera, const FlyInput& input, float elapsed_s, const Scene& scene);

 private:
  std::optional<Walker> walker_;
};

}  // namespace scree
