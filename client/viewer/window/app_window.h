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
  float wheel = 0.0F;   ///< notches, up is positive
  bool strike = false;  ///< left button went down, with the mouse held by the window; or the right trigger
  std::optional<std::string> said;  ///< a line that was written and sent
  std::vector<Action> actions;      ///< in order; without those that are the window's own (AppWindow::act)
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
  /// The person wants to end, and is asked whether that is so: Escape or Enter say yes, any other key or
  /// button no.
  bool asks_to_end() const { return asks_to_end_; }
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
  bool asks_to_end_ = false;
  std::optional<TextLine> writes_;
  std::optional<std::string> said_;
  std::optional<glm::ivec4> windowed_;  ///< place and size before the screen was full
  float wheel_ = 0.0F;
  bool strike_ = false;
  std::vector<Action> actions_;
  Gamepad pad_;
  friend struct AppWindowEvents;
};

}  // namespace scree
