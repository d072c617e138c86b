// A window with an OpenGL context, its keys and its mouse. One at a time; on the main thread only.
#pragma once

#include <memory>
#include <string>

#include "client/viewer/fly_camera.h"
#include "shared/base/result.h"

struct GLFWwindow;

namespace scree {

/// What the person did since the last frame.
struct AppInput {
  FlyInput fly;
  float elapsed_s = 0.0F;
  float wheel = 0.0F;  ///< notches, up is positive
  bool click = false;  ///< left button went down, with the mouse held by the window
  bool next_method = false;
  bool toggle_help = false;
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
  /// Pixels; nothing while minimised.
  int width() const { return width_; }
  int height() const { return height_; }
  void show_frame();

  /// For Dear ImGui's backend.
  GLFWwindow* handle() const { return window_; }

 private:
  explicit AppWindow(GLFWwindow* window);
  void hold_mouse(bool hold);

  GLFWwindow* window_;
  int width_ = 0;
  int height_ = 0;
  double last_s_ = 0.0;
  glm::dvec2 mouse_{0.0};
  bool holds_mouse_ = false;
  float wheel_ = 0.0F;
  bool click_ = false;
  bool next_method_ = false;
  bool toggle_help_ = false;
  friend struct AppWindowEvents;
};

}  // namespace scree
