// A window with an OpenGL context, its keys, its mouse, and the first gamepad if there is one. One at a time;
// on the main thread only.
#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/viewer/input/actions.h"
#include "client/viewer/input/fly_camera.h"
#include "client/viewer/input/gamepad.h"
#include "client/viewer/input/text_line.h"
#include "shared/base/result.h"

struct GLFWwindow;

namespace scree {

/// The person's input since the last frame.
struct AppInput {
  FlyInput fly;
  float elapsed_s = 0.0F;
  glm::vec2 turn_keys{0.0F};  ///< arrow keys that are down: right and down, −1 to 1
  float wheel = 0.0F;         ///< notches, up is positive
  /// How often the strike's key, the left button of a held mouse, or the right trigger went down; and whether
  /// one is down.
  int strikes = 0;
  bool strike_held = false;
  std::optional<std::string> said;  ///< a line that was written and sent
  std::vector<Action> actions;      ///< in order; without those that are the window's own (AppWindow::act)
};

/// What keys did in a menu.
struct MenuKeys {
  static constexpr int buttons = 3;
  int at = 0;  ///< the button that they are at
  bool chosen = false;
};

class AppWindow {
 public:
  /// Fails without a display or a driver of OpenGL 3.3 or OpenGL ES 3.0.
  static Result<std::unique_ptr<AppWindow>> open(int width, int height, bool debug);
  ~AppWindow();
  AppWindow(const AppWindow&) = delete;
  AppWindow& operator=(const AppWindow&) = delete;

  bool should_close() const;
  AppInput poll();
  bool holds_mouse() const { return holds_mouse_; }
  bool has_gamepad() const { return has_gamepad_; }
  /// The menu that is open, by Escape with a free mouse, has all keys until Escape, or close_menu(): the
  /// arrow keys go through its buttons, Enter or Space chooses one.
  bool has_menu() const { return menu_.has_value(); }
  /// Null: none is open.
  MenuKeys* menu() { return menu_ ? &*menu_ : nullptr; }
  void close_menu() { menu_.reset(); }
  /// After this frame, should_close().
  void end();
  /// Whether there is somebody to write a line to: else the key comes as an action.
  void let_write(bool on) { may_write_ = on; }
  /// The line that is being written, and takes all keys; nothing: none is.
  const std::optional<TextLine>& writes() const { return writes_; }
  /// Puts a text where other programs paste it from.
  void copy(const std::string& text);
  /// Pixels; nothing while minimised.
  int width() const { return width_; }
  int height() const { return height_; }
  bool minimised() const;
  /// Size in the desktop's units, those of --size; of the window that was, on a full screen.
  std::pair<int, int> window_size() const;
  /// Shows the frame; while minimised, waits a little instead.
  void show_frame();

  /// For Dear ImGui's backend.
  GLFWwindow* handle() const { return window_; }

 private:
  explicit AppWindow(GLFWwindow* window);
  void hold_mouse(bool hold);
  void press(int key);
  void press_in_menu(int key);
  void write(int key);
  void turn_full_screen();
  void act(Action action);
  void poll_keys(AppInput& input);
  void poll_gamepad(AppInput& input);

  GLFWwindow* window_;
  int width_ = 0;
  int height_ = 0;
  double last_s_ = 0.0;
  glm::dvec2 mouse_{0.0};
  bool holds_mouse_ = false;
  int pointer_settles_ = 0;  ///< polls in which the pointer's way is not the person's
  bool has_gamepad_ = false;
  std::optional<MenuKeys> menu_;
  bool may_write_ = true;
  std::optional<TextLine> writes_;
  std::optional<std::string> said_;
  std::optional<glm::ivec4> windowed_;  ///< place and size before the screen was full
  float wheel_ = 0.0F;
  int strikes_ = 0;
  std::vector<Action> actions_;
  Gamepad pad_;
  friend struct AppWindowEvents;
};

}  // namespace scree
