// What a person does at a page, until a frame takes it: keys by their codes, a mouse or fingers, a gamepad.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "client/viewer/input/gamepad.h"

namespace scree {

/// The intents of one frame.
struct PageIntents {
  FlyInput fly;
  glm::vec2 turn_keys{0.0F};  ///< arrow keys: right and down, −1 to 1
  float wheel = 0.0F;
  int strikes = 0;  ///< how often what strikes went down, and whether it is held
  bool strike_held = false;
  std::vector<Action> actions;
};

class PageInput {
 public:
  /// Pixels as the native viewer counts them.
  void turn(float right, float down) { turn_ += glm::vec2(right, down); }
  void move(const glm::vec3& way, bool fast);
  void strike() { ++strikes_; }
  /// A button or a finger that strikes is down, until it is said again.
  void hold(bool on) { holds_ = on; }
  void grow(float notches) { wheel_ += notches; }
  void act(Action action);
  /// A KeyboardEvent's code. False: it means nothing here.
  bool key(std::string_view code, bool down);
  void keys_up() {
    down_.clear();
    holds_ = false;
  }
  /// As of the W3C's standard mapping; triggers from 0 to 1.
  void pad(const PadState& sticks, uint32_t standard_buttons);

  PageIntents drain(float elapsed_s);

 private:
  bool is_down(int key) const { return down_.contains(key); }

  glm::vec2 turn_{0.0F};
  glm::vec3 move_{0.0F};
  bool fast_ = false;
  int strikes_ = 0;
  bool holds_ = false;
  float wheel_ = 0.0F;
  std::set<int> down_;  ///< keys, of GLFW
  std::vector<Action> actions_;
  Gamepad gamepad_;
  std::optional<PadState> pad_;  ///< since the last frame
};

}  // namespace scree
