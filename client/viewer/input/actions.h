// The actions that a person can trigger by key or button. One table serves the window, the help and --help.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scree {

enum class Action : uint8_t {
  next_method,
  sphere,
  box,
  tunnel,
  next_tool,
  larger,
  smaller,
  stronger,
  weaker,
  next_pattern,
  more_seeds,
  fewer_seeds,
  overlay,
  graphs,
  panel,
  help,
  free_mouse,
  end,
};

inline constexpr int unbound = -1;

struct Binding {
  Action action;
  int key = unbound;     ///< of GLFW
  int button = unbound;  ///< of GLFW's gamepads
  std::string_view named;
  std::string_view does;
};

std::span<const Binding> bindings();

/// A description of all controls by keys, mouse and gamepad, one line each.
std::string describe_controls();

}  // namespace scree
