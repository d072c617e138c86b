#include "client/web/page_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <utility>

namespace scree {
namespace {

struct CodeRow {
  std::string_view code;
  int key;
};

/// Letters and digits go by rule. Not Tab, Escape, F11 and F12, which a browser needs itself.
constexpr std::array codes{CodeRow{"Space", GLFW_KEY_SPACE},
                           CodeRow{"Quote", GLFW_KEY_APOSTROPHE},
                           CodeRow{"Comma", GLFW_KEY_COMMA},
                           CodeRow{"Minus", GLFW_KEY_MINUS},
                           CodeRow{"Period", GLFW_KEY_PERIOD},
                           CodeRow{"Semicolon", GLFW_KEY_SEMICOLON},
                           CodeRow{"Equal", GLFW_KEY_EQUAL},
                           CodeRow{"BracketLeft", GLFW_KEY_LEFT_BRACKET},
                           CodeRow{"BracketRight", GLFW_KEY_RIGHT_BRACKET},
                           CodeRow{"Enter", GLFW_KEY_ENTER},
                           CodeRow{"NumpadAdd", GLFW_KEY_EQUAL},
                           CodeRow{"NumpadSubtract", GLFW_KEY_MINUS},
                           CodeRow{"NumpadEnter", GLFW_KEY_ENTER},
                           CodeRow{"ArrowRight", GLFW_KEY_RIGHT},
                           CodeRow{"ArrowLeft", GLFW_KEY_LEFT},
                           CodeRow{"ArrowDown", GLFW_KEY_DOWN},
                           CodeRow{"ArrowUp", GLFW_KEY_UP},
                           CodeRow{"PageUp", GLFW_KEY_PAGE_UP},
                           CodeRow{"PageDown", GLFW_KEY_PAGE_DOWN},
                           CodeRow{"Home", GLFW_KEY_HOME},
                           CodeRow{"End", GLFW_KEY_END},
                           CodeRow{"Backspace", GLFW_KEY_BACKSPACE},
                           CodeRow{"F1", GLFW_KEY_F1},
                           CodeRow{"F3", GLFW_KEY_F3},
                           CodeRow{"ShiftLeft", GLFW_KEY_LEFT_SHIFT}};

constexpr std::array moves{GLFW_KEY_W,     GLFW_KEY_A,    GLFW_KEY_S,          GLFW_KEY_D,
                           GLFW_KEY_SPACE, GLFW_KEY_C,    GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT,
                           GLFW_KEY_LEFT,  GLFW_KEY_DOWN, GLFW_KEY_UP};

std::optional<int> key_of(std::string_view code) {
  if (code.size() == 4 && code.starts_with("Key") && code[3] >= 'A' && code[3] <= 'Z')
    return GLFW_KEY_A + (code[3] - 'A');
  if (code.size() == 6 && code.starts_with("Digit") && code[5] >= '0' && code[5] <= '9')
    return GLFW_KEY_0 + (code[5] - '0');
  const auto* found = std::ranges::find(codes, code, &CodeRow::code);
  return found == codes.end() ? std::nullopt : std::optional(found->key);
}

/// GLFW's button, by the number in the standard mapping; the triggers, 6 and 7, are axes there.
constexpr std::array<int, 17> standard_buttons{GLFW_GAMEPAD_BUTTON_A,
                                               GLFW_GAMEPAD_BUTTON_B,
                                               GLFW_GAMEPAD_BUTTON_X,
                                               GLFW_GAMEPAD_BUTTON_Y,
                                               GLFW_GAMEPAD_BUTTON_LEFT_BUMPER,
                                               GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
                                               unbound,
                                               unbound,
                                               GLFW_GAMEPAD_BUTTON_BACK,
                                               GLFW_GAMEPAD_BUTTON_START,
                                               GLFW_GAMEPAD_BUTTON_LEFT_THUMB,
                                               GLFW_GAMEPAD_BUTTON_RIGHT_THUMB,
                                               GLFW_GAMEPAD_BUTTON_DPAD_UP,
                                               GLFW_GAMEPAD_BUTTON_DPAD_DOWN,
                                               GLFW_GAMEPAD_BUTTON_DPAD_LEFT,
                                               GLFW_GAMEPAD_BUTTON_DPAD_RIGHT,
                                               GLFW_GAMEPAD_BUTTON_GUIDE};

}  // namespace

void PageInput::act(Action action) {
  if (action == Action::strike) return strike();
  actions_.push_back(action);
}

void PageInput::move(const glm::vec3& way, bool fast) {
  move_ = glm::clamp(way, -1.0F, 1.0F);
  fast_ = fast;
}

bool PageInput::key(std::string_view code, bool down) {
  const std::optional<int> key = key_of(code);
  if (!key) return false;
  bool known = std::ranges::find(moves, *key) != moves.end();
  const bool went_down = down && !is_down(*key);
  if (down) {
    down_.insert(*key);
  } else {
    down_.erase(*key);
  }
  for (const Binding& binding : bindings()) {
    if (binding.key != *key) continue;
    known = true;
    if (went_down) act(binding.action);
  }
  return known;
}

void PageInput::pad(const PadState& sticks, uint32_t pressed) {
  pad_ = sticks;
  pad_->left_trigger = 2.0F * sticks.left_trigger - 1.0F;
  pad_->right_trigger = 2.0F * sticks.right_trigger - 1.0F;
  pad_->buttons = 0;
  for (size_t i = 0; i < standard_buttons.size(); ++i)
    if (standard_buttons[i] != unbound && (pressed >> i & 1U) != 0)
      pad_->buttons |= 1U << static_cast<unsigned>(standard_buttons[i]);
}

PageIntents PageInput::drain(float elapsed_s) {
  const auto axis = [this](int plus, int minus) {
    return static_cast<float>(is_down(plus)) - static_cast<float>(is_down(minus));
  };
  PageIntents intents;
  intents.fly.move = move_ + glm::vec3(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_SPACE, GLFW_KEY_C),
                                       axis(GLFW_KEY_W, GLFW_KEY_S));
  intents.fly.fast = fast_ || is_down(GLFW_KEY_LEFT_SHIFT);
  intents.fly.turn = std::exchange(turn_, glm::vec2(0.0F));
  intents.turn_keys = {axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), axis(GLFW_KEY_DOWN, GLFW_KEY_UP)};
  intents.strikes = std::exchange(strikes_, 0);
  intents.strike_held = holds_ || is_down(GLFW_KEY_E);
  intents.wheel = std::exchange(wheel_, 0.0F);
  intents.actions = std::exchange(actions_, {});
  if (!pad_) return intents;
  const std::vector<Action> of_pad =
      gamepad_.step(*std::exchange(pad_, std::nullopt), elapsed_s, intents.fly);
  intents.actions.insert(intents.actions.end(), of_pad.begin(), of_pad.end());
  intents.strikes += static_cast<int>(gamepad_.struck());
  intents.strike_held = intents.strike_held || gamepad_.holds_trigger();
  return intents;
}

}  // namespace scree
