#include "client/viewer/session/on_foot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/base/check.h"

namespace scree {
namespace {

/// How fast the eye's height over the feet changes, so that steps are climbed without a jolt.
constexpr float step_rise_m_s = 3.0F;

}  // namespace

SolidGround ground_of_scene(const Scene& scene, glm::vec3 about_m) {
  SolidGround ground(scene.field, about_m);
  for (const auto& [id, piece] : scene.pieces) ground.add(*piece.volume, piece.pose);
  for (const auto& [id, prop] : scene.props) ground.add(*prop.prop, prop.pose);
  return ground;
}

WalkInput walk_input_of(const Camera& camera, const FlyInput& input) {
  const glm::vec3 ahead(-std::sin(camera.yaw), 0.0F, -std::cos(camera.yaw));
  return {camera.right() * input.move.x + ahead * input.move.z, input.fast, input.move.y > 0.0F};
}

void turn_by(Camera& camera, const FlyInput& input, float elapsed_s) {
  FlyInput turned = input;
  turned.move = glm::vec3(0.0F);
  fly(camera, turned, elapsed_s);
}

void carry(Camera& camera, glm::vec3 eye_m, bool steps, float elapsed_s) {
  const float most_m = step_rise_m_s * elapsed_s;
  const float before_m = camera.eye_m.y;
  camera.eye_m = eye_m;
  if (steps) camera.eye_m.y = std::clamp(eye_m.y, before_m - most_m, before_m + most_m);
}

void OnFoot::change(const Camera& camera) {
  if (walker_) return stop();
  walker_.emplace(camera.eye_m - glm::vec3(0.0F, Walker::eye_above_m, 0.0F));
}

void OnFoot::step(Camera& camera, const FlyInput& input, float elapsed_s, const Scene& scene) {
  CHECK(walks());
  turn_by(camera, input, elapsed_s);
  SolidGround ground = ground_of_scene(scene, walker_->feet_m());
  const bool stood = walker_->stands();
  walker_->step(walk_input_of(camera, input), elapsed_s, ground);
  const glm::vec3 eye_m = walker_->eye_m();
  const bool steps = stood && walker_->stands() && std::abs(eye_m.y - camera.eye_m.y) < 2.0F * Walker::step_m;
  carry(camera, eye_m, steps, elapsed_s);
}

}  // namespace scree
