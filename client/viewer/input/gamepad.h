// Translates a gamepad's sticks and buttons into camera movement and actions. No window.
#pragma once

#include <cstdint>
#include <vector>

#include "client/viewer/input/actions.h"
#include "client/viewer/input/fly_camera.h"

namespace scree {

/// At some moment. Axes from −1 to 1, right and down are positive; triggers −1 released, 1 pressed.
struct PadState {
  float left_x = 0.0F;
  float left_y = 0.0F;
  float right_x = 0.0F;
  float right_y = 0.0F;
  float left_trigger = -1.0F;
  float right_trigger = -1.0F;
  uint32_t buttons = 0;  ///< bit i: GLFW's gamepad button i is down
};

class Gamepad {
 public:
  /// Adds the sticks' movement to `fly`; returns the actions of the buttons that went down since the last
  /// step.
  std::vector<Action> step(const PadState& now, float elapsed_s, FlyInput& fly);
  /// The right trigger went down in the last step.
  bool struck() const { return struck_; }
  bool holds_trigger() const { return before_.right_trigger > 0.0F; }

 private:
  PadState before_;
  bool struck_ = false;
};

}  // namespace scree
