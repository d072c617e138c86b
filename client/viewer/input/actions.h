// The actions that a person can trigger by key or button. One table serves the window, the help and --help.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

enum class Action : uint8_t {
  strike,
  dig,
  place,
  carve,
  fill,
  paint,
  next_tool,
  next_use,
  next_material,
  give_away,
  larger,
  smaller,
  stronger,
  weaker,
  next_pattern,
  more_seeds,
  fewer_seeds,
  next_method,
  walk,
  narrower_view,
  wider_view,
  slower_mouse,
  faster_mouse,
  smaller_text,
  larger_text,
  next_eye,
  replay_play,
  replay_turn,
  replay_slower,
  replay_faster,
  replay_second_back,
  replay_second_on,
  replay_tick_back,
  replay_tick_on,
  replay_previous_event,
  replay_next_event,
  replay_start,
  replay_end,
  present,
  picture,
  copy_place,
  record_path,
  talk,
  persons,
  mute,
  overlay,
  figures,
  all_figures,
  graphs,
  panel,
  help,
  hide,
  full_screen,
  free_mouse,
  menu,
};

inline constexpr int unbound = -1;

/// Whose controls are told: a live world has no timeline, and a replay is not changed.
enum class ControlsOf : uint8_t { live, replay, both };

struct Binding {
  Action action;
  std::string_view name;  ///< of the action, for programs
  int key = unbound;      ///< of GLFW
  int button = unbound;   ///< of GLFW's gamepads
  std::string_view key_name;
  std::string_view button_name;
  std::string_view does;
  ControlsOf of = ControlsOf::both;  ///< where alone it does something
};

/// How much of the controls is told; a key goes through them, round.
enum class Telling : uint8_t { nothing = 0, basics = 1, all = 2 };

struct TellingRow {
  std::string_view name;
};

constexpr TellingRow row_of(Telling telling) {
  switch (telling) {
    case Telling::nothing:
      return {.name = "nothing"};
    case Telling::basics:
      return {.name = "basics"};
    case Telling::all:
      return {.name = "all"};
  }
  return {};
}

std::span<const Binding> bindings();
std::optional<Action> action_named(std::string_view name);

constexpr Telling after(Telling telling) {
  return static_cast<Telling>((static_cast<size_t>(telling) + 1) % kind_count<Telling>);
}

/// A description of the controls by keys and mouse, and by gamepad if wanted, one line each.
std::string describe_controls(Telling telling, bool gamepad, ControlsOf of);

}  // namespace scree
