#include "client/viewer/input/fly_camera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/viewer/base/limits.h"

namespace scree {
namespace {

constexpr float speed_m_s = 9.0F;
constexpr float fast_factor = 4.0F;
constexpr float radians_per_pixel = 0.0025F;
constexpr float pitch_max = 1.55F;
/// Longest step, seconds: after a stall, the camera does not jump. Slow machines draw three frames a second.
constexpr float step_max_s = 0.5F;

/// As if by the mouse: a quarter of a circle a second.
constexpr float key_pixels_per_s = 630.0F;
/// A slower frame turns no farther by a key: a short press must not miss what it is aimed at.
constexpr float key_step_max_s = 0.1F;

}  // namespace

glm::vec2 turn_by_keys(glm::vec2 keys, float elapsed_s) {
  return keys * (key_pixels_per_s * glm::min(elapsed_s, key_step_max_s));
}

void fly(Camera& camera, const FlyInput& input, float elapsed_s) {
  camera.yaw -= input.turn.x * radians_per_pixel;
  camera.pitch = glm::clamp(camera.pitch - input.turn.y * radians_per_pixel, -pitch_max, pitch_max);
  const glm::vec3 move = camera.right() * input.move.x + glm::vec3(0.0F, 1.0F, 0.0F) * input.move.y +
                         camera.forward() * input.move.z;
  if (glm::dot(move, move) < 1e-6F) return;
  const float speed = speed_m_s * (input.fast ? fast_factor : 1.0F);
  const float part = glm::min(glm::length(move), 1.0F);
  camera.eye_m += glm::normalize(move) * (part * speed * glm::min(elapsed_s, step_max_s));
  const glm::vec3 half(limits::world_half_width_m, limits::world_half_height_m, limits::world_half_width_m);
  camera.eye_m = glm::clamp(camera.eye_m, -half, half);
}

}  // namespace scree
