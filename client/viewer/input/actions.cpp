#include "client/viewer/input/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <array>
#include <utility>

namespace scree {
namespace {

constexpr std::array table{
    Binding{Action::sphere, GLFW_KEY_1, unbound, "1", "tool: sphere"},
    Binding{Action::box, GLFW_KEY_2, unbound, "2", "tool: box"},
    Binding{Action::tunnel, GLFW_KEY_3, unbound, "3", "tool: tunnel"},
    Binding{Action::next_tool, unbound, GLFW_GAMEPAD_BUTTON_A, "pad A", "next tool"},
    Binding{Action::larger, GLFW_KEY_EQUAL, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, "=  pad RB", "larger"},
    Binding{Action::smaller, GLFW_KEY_MINUS, GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, "-  pad LB", "smaller"},
    Binding{Action::stronger, GLFW_KEY_X, GLFW_GAMEPAD_BUTTON_DPAD_UP, "X  pad up", "stronger blast"},
    Binding{Action::weaker, GLFW_KEY_Z, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, "Z  pad down", "weaker blast"},
    Binding{Action::next_pattern, GLFW_KEY_R, GLFW_GAMEPAD_BUTTON_X, "R  pad X", "pattern of the cracks"},
    Binding{Action::more_seeds, GLFW_KEY_RIGHT_BRACKET, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, "]  pad right",
            "more pieces"},
    Binding{Action::fewer_seeds, GLFW_KEY_LEFT_BRACKET, GLFW_GAMEPAD_BUTTON_DPAD_LEFT, "[  pad left",
            "fewer pieces"},
    Binding{Action::next_method, GLFW_KEY_M, GLFW_GAMEPAD_BUTTON_Y, "M  pad Y", "draw by the next method"},
    Binding{Action::overlay, GLFW_KEY_O, unbound, "O", "borders, interest, bodies and contacts"},
    Binding{Action::graphs, GLFW_KEY_G, unbound, "G", "graphs"},
    Binding{Action::panel, GLFW_KEY_P, GLFW_GAMEPAD_BUTTON_START, "P  pad start",
            "panel of methods and tools (free the mouse to use it)"},
    Binding{Action::help, GLFW_KEY_H, GLFW_GAMEPAD_BUTTON_BACK, "H  pad back", "this help"},
    Binding{Action::free_mouse, GLFW_KEY_TAB, unbound, "Tab", "free the mouse, or take it"},
    Binding{Action::end, GLFW_KEY_ESCAPE, unbound, "Esc", "end"},
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> motions{{
    {"W A S D  pad left stick", "fly (Shift or left trigger: faster)"},
    {"Space C  pad stick presses", "up, down"},
    {"mouse  pad right stick", "look"},
    {"left click  pad right trigger", "strike; the wheel sets the size"},
}};

constexpr size_t column = 32;

}  // namespace

std::span<const Binding> bindings() {
  return table;
}

std::string describe_controls() {
  std::string text;
  const auto add = [&](std::string_view named, std::string_view does) {
    text.append(named).append(column - named.size(), ' ').append(does).append("\n");
  };
  for (const auto& [named, does] : motions) add(named, does);
  for (const Binding& binding : table) add(binding.named, binding.does);
  return text;
}

}  // namespace scree
