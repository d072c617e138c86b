#include "client/viewer/input/gamepad.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cmath>
#include <utility>

namespace scree {
namespace {

/// Tilt that counts as none: worn sticks do not return to their middle.
constexpr float dead_zone = 0.15F;
constexpr float turn_pixels_per_s = 900.0F;  ///< of the mouse's, at full tilt

/// The tilt from the edge of the dead zone on, squared: fine control near the middle.
float tilt(float axis) {
  const float past = std::abs(axis) - dead_zone;
  if (past <= 0.0F) return 0.0F;
  const float part = past / (1.0F - dead_zone);
  return std::copysign(part * part, axis);
}

bool pressed(float trigger) {
  return trigger > 0.0F;
}

}  // namespace

std::vector<Action> Gamepad::step(const PadState& now, float elapsed_s, FlyInput& fly) {
  const PadState before = std::exchange(before_, now);
  const auto down = [&](int button) { return (now.buttons >> static_cast<unsigned>(button) & 1U) != 0; };
  const auto stick = [&](int button) { return down(button) ? 1.0F : 0.0F; };
  fly.move.x += tilt(now.left_x);
  fly.move.y += stick(GLFW_GAMEPAD_BUTTON_LEFT_THUMB) - stick(GLFW_GAMEPAD_BUTTON_RIGHT_THUMB);
  fly.move.z -= tilt(now.left_y);
  fly.turn += glm::vec2(tilt(now.right_x), tilt(now.right_y)) * (turn_pixels_per_s * elapsed_s);
  fly.fast = fly.fast || pressed(now.left_trigger);
  struck_ = pressed(now.right_trigger) && !pressed(before.right_trigger);
  std::vector<Action> actions;
  for (const Binding& binding : bindings())
    if (binding.button != unbound && down(binding.button) &&
        (before.buttons >> static_cast<unsigned>(binding.button) & 1U) == 0)
      actions.push_back(binding.action);
  return actions;
}

}  // namespace scree
