#include "client/viewer/app_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <utility>

namespace scree {

namespace {

constexpr int samples = 4;

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

GLFWwindow* open_with(int api, int major, int minor, int width, int height, bool debug) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, api);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
  if (api == GLFW_OPENGL_API) glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SAMPLES, samples);
  return glfwCreateWindow(width, height, "Scree", nullptr, nullptr);
}

}  // namespace

/// GLFW calls these; it hands back the window's pointer.
struct AppWindowEvents {
  static AppWindow& of(GLFWwindow* window) {
    return *static_cast<AppWindow*>(glfwGetWindowUserPointer(window));
  }

  static void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (key == GLFW_KEY_H) of(window).toggle_help_ = true;
    if (key == GLFW_KEY_M) of(window).next_method_ = true;
    if (key == GLFW_KEY_TAB) of(window).hold_mouse(!of(window).holds_mouse_);
  }
  static void on_button(GLFWwindow* window, int button, int action, int) {
    if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS) return;
    // The first click takes the mouse; only the following ones carve.
    if (of(window).holds_mouse_) {
      of(window).click_ = true;
    } else {
      of(window).hold_mouse(true);
    }
  }
  static void on_scroll(GLFWwindow* window, double, double notches) {
    of(window).wheel_ += static_cast<float>(notches);
  }
};

Result<std::unique_ptr<AppWindow>> AppWindow::open(int width, int height, bool debug) {
  if (glfwInit() != GLFW_TRUE)
    return fail("no window can be opened (" + last_error() +
                "); use --offscreen --screenshot FILE without one");
  GLFWwindow* window = open_with(GLFW_OPENGL_API, 3, 3, width, height, debug);
  if (window == nullptr) window = open_with(GLFW_OPENGL_ES_API, 3, 0, width, height, debug);
  if (window == nullptr) {
    const std::string reason = last_error();
    glfwTerminate();
    return fail("no window with OpenGL 3.3 or OpenGL ES 3.0 can be opened (" + reason +
                "); install a newer driver, or Mesa's software one (libgl1-mesa-dri)");
  }
  return std::unique_ptr<AppWindow>(new AppWindow(window));
}

AppWindow::AppWindow(GLFWwindow* window) : window_(window) {
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, AppWindowEvents::on_key);
  glfwSetMouseButtonCallback(window_, AppWindowEvents::on_button);
  glfwSetScrollCallback(window_, AppWindowEvents::on_scroll);
  last_s_ = glfwGetTime();
}

AppWindow::~AppWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool AppWindow::should_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void AppWindow::hold_mouse(bool hold) {
  holds_mouse_ = hold;
  glfwSetInputMode(window_, GLFW_CURSOR, hold ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  glfwGetCursorPos(window_, &mouse_.x, &mouse_.y);
}

AppInput AppWindow::poll() {
  glfwPollEvents();
  glfwGetFramebufferSize(window_, &width_, &height_);
  AppInput input;
  const double now_s = glfwGetTime();
  input.elapsed_s = static_cast<float>(now_s - std::exchange(last_s_, now_s));
  const auto axis = [this](int plus, int minus) {
    return static_cast<float>((glfwGetKey(window_, plus) == GLFW_PRESS) -
                              (glfwGetKey(window_, minus) == GLFW_PRESS));
  };
  input.fly.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_SPACE, GLFW_KEY_C),
                    axis(GLFW_KEY_W, GLFW_KEY_S)};
  input.fly.fast = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
  if (holds_mouse_) {
    glm::dvec2 mouse;
    glfwGetCursorPos(window_, &mouse.x, &mouse.y);
    input.fly.look = glm::vec2(mouse - std::exchange(mouse_, mouse));
  }
  input.wheel = std::exchange(wheel_, 0.0F);
  input.click = std::exchange(click_, false);
  input.next_method = std::exchange(next_method_, false);
  input.toggle_help = std::exchange(toggle_help_, false);
  return input;
}

void AppWindow::show_frame() {
  glfwSwapBuffers(window_);
}

}  // namespace scree
