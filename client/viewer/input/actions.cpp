#include "client/viewer/input/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>

namespace scree {
namespace {

constexpr std::array table{
    Binding{Action::strike, "strike", GLFW_KEY_E, unbound, "E", "", "use the tool; held, again and again",
            ControlsOf::live},
    Binding{Action::dig, "dig", GLFW_KEY_1, unbound, "1", "", "dig: rock goes into your store",
            ControlsOf::live},
    Binding{Action::place, "place", GLFW_KEY_2, unbound, "2", "", "place what you carry", ControlsOf::live},
    Binding{Action::carve, "carve", GLFW_KEY_3, unbound, "3", "", "carve: rock breaks, and its pieces fly",
            ControlsOf::live},
    Binding{Action::fill, "fill", GLFW_KEY_4, unbound, "4", "", "fill with new rock", ControlsOf::live},
    Binding{Action::paint, "paint", GLFW_KEY_5, unbound, "5", "", "paint: rock becomes another material",
            ControlsOf::live},
    Binding{Action::next_use, "next_use", GLFW_KEY_F, GLFW_GAMEPAD_BUTTON_B, "F", "pad B",
            "the next of these five", ControlsOf::live},
    Binding{Action::next_tool, "next_tool", GLFW_KEY_T, GLFW_GAMEPAD_BUTTON_A, "T", "pad A",
            "shape: sphere, box, tunnel or crater", ControlsOf::live},
    Binding{Action::next_material, "next_material", GLFW_KEY_B, unbound, "B", "",
            "material to place, fill or paint", ControlsOf::live},
    Binding{Action::give_away, "give_away", GLFW_KEY_U, unbound, "U", "",
            "unload: give what you carry to the world's store", ControlsOf::live},
    Binding{Action::larger, "larger", GLFW_KEY_EQUAL, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, "=", "pad RB",
            "larger", ControlsOf::live},
    Binding{Action::smaller, "smaller", GLFW_KEY_MINUS, GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, "-", "pad LB",
            "smaller", ControlsOf::live},
    Binding{Action::stronger, "stronger", GLFW_KEY_X, GLFW_GAMEPAD_BUTTON_DPAD_UP, "X", "pad up",
            "stronger blast", ControlsOf::live},
    Binding{Action::weaker, "weaker", GLFW_KEY_Z, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, "Z", "pad down",
            "weaker blast", ControlsOf::live},
    Binding{Action::next_pattern, "next_pattern", GLFW_KEY_R, GLFW_GAMEPAD_BUTTON_X, "R", "pad X",
            "pattern of the cracks", ControlsOf::live},
    Binding{Action::more_seeds, "more_seeds", GLFW_KEY_RIGHT_BRACKET, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, "]",
            "pad right", "more pieces", ControlsOf::live},
    Binding{Action::fewer_seeds, "fewer_seeds", GLFW_KEY_LEFT_BRACKET, GLFW_GAMEPAD_BUTTON_DPAD_LEFT, "[",
            "pad left", "fewer pieces", ControlsOf::live},
    Binding{Action::next_method, "next_method", GLFW_KEY_M, GLFW_GAMEPAD_BUTTON_Y, "M", "pad Y",
            "draw by the next method"},
    Binding{Action::walk, "walk", GLFW_KEY_Q, unbound, "Q", "", "walk, or fly"},
    Binding{Action::narrower_view, "narrower_view", GLFW_KEY_COMMA, unbound, ",", "",
            "narrower view (as a longer lens)"},
    Binding{Action::wider_view, "wider_view", GLFW_KEY_PERIOD, unbound, ".", "", "wider view"},
    Binding{Action::slower_mouse, "slower_mouse", GLFW_KEY_SEMICOLON, unbound, ";", "", "slower mouse"},
    Binding{Action::faster_mouse, "faster_mouse", GLFW_KEY_APOSTROPHE, unbound, "'", "", "faster mouse"},
    Binding{Action::smaller_text, "smaller_text", GLFW_KEY_PAGE_DOWN, unbound, "Page Down", "",
            "smaller text"},
    Binding{Action::larger_text, "larger_text", GLFW_KEY_PAGE_UP, unbound, "Page Up", "", "larger text"},
    Binding{Action::next_eye, "next_eye", GLFW_KEY_N, unbound, "N", "",
            "look through the next person's eye, or your own"},
    Binding{Action::replay_play, "replay_play", GLFW_KEY_J, unbound, "J", "", "replay: play, or hold",
            ControlsOf::replay},
    Binding{Action::replay_turn, "replay_turn", GLFW_KEY_Y, unbound, "Y", "",
            "replay: play backwards, or forwards", ControlsOf::replay},
    Binding{Action::replay_slower, "replay_slower", GLFW_KEY_DOWN, unbound, "Down", "", "replay: slower",
            ControlsOf::replay},
    Binding{Action::replay_faster, "replay_faster", GLFW_KEY_UP, unbound, "Up", "", "replay: faster",
            ControlsOf::replay},
    Binding{Action::replay_second_back, "replay_second_back", GLFW_KEY_LEFT, unbound, "Left", "",
            "replay: a second back", ControlsOf::replay},
    Binding{Action::replay_second_on, "replay_second_on", GLFW_KEY_RIGHT, unbound, "Right", "",
            "replay: a second on", ControlsOf::replay},
    Binding{Action::replay_tick_back, "replay_tick_back", GLFW_KEY_7, unbound, "7", "", "replay: a tick back",
            ControlsOf::replay},
    Binding{Action::replay_tick_on, "replay_tick_on", GLFW_KEY_8, unbound, "8", "", "replay: a tick on",
            ControlsOf::replay},
    Binding{Action::replay_previous_event, "replay_previous_event", GLFW_KEY_9, unbound, "9", "",
            "replay: to the previous event", ControlsOf::replay},
    Binding{Action::replay_next_event, "replay_next_event", GLFW_KEY_0, unbound, "0", "",
            "replay: to the next event", ControlsOf::replay},
    Binding{Action::replay_start, "replay_start", GLFW_KEY_HOME, unbound, "Home", "", "replay: to its start",
            ControlsOf::replay},
    Binding{Action::replay_end, "replay_end", GLFW_KEY_END, unbound, "End", "", "replay: to its end",
            ControlsOf::replay},
    Binding{Action::present, "present", GLFW_KEY_BACKSPACE, unbound, "Backspace", "",
            "replay: back to the present, if you came from there", ControlsOf::replay},
    Binding{Action::picture, "picture", GLFW_KEY_F12, unbound, "F12", "",
            "take a picture (a PNG in this folder)"},
    Binding{Action::copy_place, "copy_place", GLFW_KEY_V, unbound, "V", "",
            "copy the camera's place as --camera"},
    Binding{Action::record_path, "record_path", GLFW_KEY_K, unbound, "K", "",
            "record a camera path for --path, or end it"},
    Binding{Action::talk, "talk", GLFW_KEY_ENTER, unbound, "Enter", "",
            "say something to all (Enter sends, Esc does not)"},
    Binding{Action::persons, "persons", GLFW_KEY_L, unbound, "L", "", "who is there"},
    Binding{Action::mute, "mute", GLFW_KEY_6, unbound, "6", "", "sound off, or on"},
    Binding{Action::overlay, "overlay", GLFW_KEY_O, unbound, "O", "",
            "borders, interest, bodies and contacts"},
    Binding{Action::figures, "figures", GLFW_KEY_I, unbound, "I", "", "figures"},
    Binding{Action::all_figures, "all_figures", GLFW_KEY_F3, unbound, "F3", "", "a developer's figures"},
    Binding{Action::graphs, "graphs", GLFW_KEY_G, unbound, "G", "", "graphs"},
    Binding{Action::panel, "panel", GLFW_KEY_P, GLFW_GAMEPAD_BUTTON_START, "P", "pad start",
            "panel of the tool and the view (free the mouse to use it)"},
    Binding{Action::help, "help", GLFW_KEY_H, GLFW_GAMEPAD_BUTTON_BACK, "H", "pad back",
            "more help, or none"},
    Binding{Action::hide, "hide", GLFW_KEY_F1, unbound, "F1", "", "hide all of this, or show it"},
    Binding{Action::full_screen, "full_screen", GLFW_KEY_F11, unbound, "F11", "", "full screen, or a window"},
    Binding{Action::free_mouse, "free_mouse", GLFW_KEY_TAB, unbound, "Tab", "", "free the mouse, or take it"},
    Binding{Action::menu, "menu", GLFW_KEY_ESCAPE, unbound, "Esc", "",
            "free the mouse; then the menu, which ends"},
};

/// What no single key does.
struct CameraMotion {
  std::string_view by_hand;
  std::string_view by_gamepad;
  std::string_view does;
  bool changes = false;  ///< the world, which a replay does not let
};

constexpr std::array<CameraMotion, 4> motions{{
    {"W A S D", "pad left stick", "move (Shift or left trigger: faster)"},
    {"Space C", "pad stick presses", "up, down; on foot, Space jumps"},
    {"mouse", "pad right stick", "look; so do the arrow keys"},
    {"left click", "pad right trigger", "use the tool; the wheel sets its size", true},
}};

/// What a newcomer needs; the help says where the rest is.
constexpr std::array basics{Action::strike, Action::dig,  Action::place, Action::carve,
                            Action::walk,   Action::help, Action::menu};
constexpr std::array replay_basics{Action::next_eye,
                                   Action::replay_play,
                                   Action::replay_second_back,
                                   Action::replay_second_on,
                                   Action::replay_previous_event,
                                   Action::replay_next_event,
                                   Action::panel,
                                   Action::help,
                                   Action::free_mouse,
                                   Action::menu};

bool contains(std::span<const Action> actions, Action action) {
  return std::ranges::find(actions, action) != actions.end();
}

constexpr size_t column = 12, gamepad_column = 20;

}  // namespace

std::span<const Binding> bindings() {
  return table;
}

std::optional<Action> action_named(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &Binding::name);
  return found == table.end() ? std::nullopt : std::optional(found->action);
}

std::string describe_controls(Telling telling, bool gamepad, ControlsOf of) {
  std::string text;
  if (telling == Telling::nothing) return text;
  const auto add = [&](std::string_view key, std::string_view button, std::string_view does) {
    if (key.empty() && !gamepad) return;
    text.append(key).append(column - key.size(), ' ');
    if (gamepad) text.append(button).append(gamepad_column - button.size(), ' ');
    text.append(does).append("\n");
  };
  for (const CameraMotion& motion : motions)
    if (of != ControlsOf::replay || !motion.changes) add(motion.by_hand, motion.by_gamepad, motion.does);
  const std::span<const Action> first =
      of == ControlsOf::replay ? std::span<const Action>(replay_basics) : basics;
  for (const Binding& binding : table)
    if (telling == Telling::all ? of == ControlsOf::both || binding.of == ControlsOf::both || binding.of == of
                                : contains(first, binding.action))
      add(binding.key_name, binding.button_name, binding.does);
  return text;
}

}  // namespace scree
