#include "client/viewer/window/app_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>
#include <utility>

#include "proto/limits.h"

namespace scree {

namespace {

constexpr double minimised_pause_s = 0.02;  ///< about a tick: the world goes on
/// Polls until the system has put the pointer into the middle of a window of another size.
constexpr int pointer_settles_polls = 4;

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
  return glfwCreateWindow(width, height, "Scree", nullptr, nullptr);
}

/// The key of the main block that means the same as one of the number pad.
int main_key(int key) {
  if (key == GLFW_KEY_KP_ADD) return GLFW_KEY_EQUAL;
  if (key == GLFW_KEY_KP_SUBTRACT) return GLFW_KEY_MINUS;
  return key == GLFW_KEY_KP_ENTER ? GLFW_KEY_ENTER : key;
}

}  // namespace

/// GLFW calls these; it hands back the window's pointer.
struct AppWindowEvents {
  static AppWindow& of(GLFWwindow* window) {
    return *static_cast<AppWindow*>(glfwGetWindowUserPointer(window));
  }

  static void on_key(GLFWwindow* window, int key, int, int action, int) {
    AppWindow& app = of(window);
    key = main_key(key);
    if (app.writes_ && action != GLFW_RELEASE) return app.write(key);
    if (action == GLFW_PRESS) app.press(key);
  }
  static void on_char(GLFWwindow* window, unsigned code_point) {
    if (auto& line = of(window).writes_) line->add(code_point);
  }
  static void on_button(GLFWwindow* window, int button, int action, int) {
    if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS || of(window).has_menu()) return;
    // The panel takes clicks on it.
    if (ImGui::GetCurrentContext() != nullptr && ImGui::GetIO().WantCaptureMouse) return;
    // The first click takes the mouse; only the following ones strike.
    if (of(window).holds_mouse_) {
      ++of(window).strikes_;
    } else {
      of(window).hold_mouse(true);
    }
  }
  /// Else the click that brings the window back would strike.
  static void on_focus(GLFWwindow* window, int focused) {
    if (focused == GLFW_FALSE && of(window).holds_mouse_) of(window).hold_mouse(false);
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
  glfwSetCharCallback(window_, AppWindowEvents::on_char);
  glfwSetMouseButtonCallback(window_, AppWindowEvents::on_button);
  glfwSetScrollCallback(window_, AppWindowEvents::on_scroll);
  glfwSetWindowFocusCallback(window_, AppWindowEvents::on_focus);
  // A key that went down and up between two slow frames was down in one.
  glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);
  last_s_ = glfwGetTime();
}

AppWindow::~AppWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool AppWindow::should_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void AppWindow::end() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void AppWindow::hold_mouse(bool hold) {
  holds_mouse_ = hold;
  glfwSetInputMode(window_, GLFW_CURSOR, hold ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  glfwGetCursorPos(window_, &mouse_.x, &mouse_.y);
}

void AppWindow::copy(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void AppWindow::turn_full_screen() {
  if (windowed_) {
    glfwSetWindowMonitor(window_, nullptr, windowed_->x, windowed_->y, windowed_->z, windowed_->w,
                         GLFW_DONT_CARE);
    windowed_.reset();
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  if (mode == nullptr) return;
  glm::ivec4 place(0);
  glfwGetWindowPos(window_, &place.x, &place.y);
  glfwGetWindowSize(window_, &place.z, &place.w);
  windowed_ = place;
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void AppWindow::press(int key) {
  if (menu_) return press_in_menu(key);
  for (const Binding& binding : bindings())
    if (binding.key == key) act(binding.action);
}

void AppWindow::press_in_menu(int key) {
  const auto go = [this](int by) { menu_->at = (menu_->at + by + MenuKeys::buttons) % MenuKeys::buttons; };
  if (key == GLFW_KEY_ESCAPE) return close_menu();
  if (key == GLFW_KEY_DOWN || key == GLFW_KEY_TAB) go(1);
  if (key == GLFW_KEY_UP) go(-1);
  menu_->chosen = menu_->chosen || key == GLFW_KEY_ENTER || key == GLFW_KEY_SPACE;
}

void AppWindow::write(int key) {
  if (key == GLFW_KEY_BACKSPACE) return writes_->erase();
  const bool sends = key == GLFW_KEY_ENTER;
  if (sends) said_ = writes_->text();
  if (sends || key == GLFW_KEY_ESCAPE) writes_.reset();
}

void AppWindow::act(Action action) {
  switch (action) {
    case Action::talk:
      if (!may_write_) return actions_.push_back(action);
      writes_.emplace(limits::line_bytes_max);
      break;
    case Action::menu:
      if (holds_mouse_) return hold_mouse(false);
      menu_.emplace();
      break;
    case Action::strike:
      ++strikes_;
      break;
    case Action::free_mouse:
      hold_mouse(!holds_mouse_);
      break;
    case Action::full_screen:
      turn_full_screen();
      break;
    default:
      actions_.push_back(action);
  }
}

AppInput AppWindow::poll() {
  glfwPollEvents();
  const int width = width_, height = height_;
  glfwGetFramebufferSize(window_, &width_, &height_);
  if (width != width_ || height != height_) pointer_settles_ = pointer_settles_polls;
  AppInput input;
  const double now_s = glfwGetTime();
  input.elapsed_s = static_cast<float>(now_s - std::exchange(last_s_, now_s));
  poll_keys(input);
  poll_gamepad(input);
  input.wheel = std::exchange(wheel_, 0.0F);
  input.strikes = std::exchange(strikes_, 0);
  input.said = std::exchange(said_, std::nullopt);
  input.actions = std::exchange(actions_, {});
  return input;
}

void AppWindow::poll_keys(AppInput& input) {
  // It is asked in any case: a key that was pressed while a line was written is forgotten.
  const auto down = [this](int key) {
    const bool pressed = glfwGetKey(window_, key) == GLFW_PRESS;
    return pressed && !writes_ && !menu_;
  };
  const auto axis = [&](int plus, int minus) {
    const float there = down(plus) ? 1.0F : 0.0F;
    return there - (down(minus) ? 1.0F : 0.0F);
  };
  input.fly.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_SPACE, GLFW_KEY_C),
                    axis(GLFW_KEY_W, GLFW_KEY_S)};
  input.fly.fast = down(GLFW_KEY_LEFT_SHIFT);
  input.turn_keys = {axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), axis(GLFW_KEY_DOWN, GLFW_KEY_UP)};
  input.strike_held = down(GLFW_KEY_E);
  if (!holds_mouse_) return;
  input.strike_held = input.strike_held || glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  glm::dvec2 mouse;
  glfwGetCursorPos(window_, &mouse.x, &mouse.y);
  const glm::vec2 moved(mouse - std::exchange(mouse_, mouse));
  if (pointer_settles_ == 0) {
    input.fly.turn = moved;
  } else {
    --pointer_settles_;
  }
}

/// The first gamepad that GLFW knows a mapping for.
void AppWindow::poll_gamepad(AppInput& input) {
  int pad = GLFW_JOYSTICK_1;
  while (pad <= GLFW_JOYSTICK_LAST && glfwJoystickIsGamepad(pad) != GLFW_TRUE) ++pad;
  GLFWgamepadstate state;
  has_gamepad_ = pad <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(pad, &state) == GLFW_TRUE;
  if (!has_gamepad_) return;
  PadState now{state.axes[GLFW_GAMEPAD_AXIS_LEFT_X],
               state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y],
               state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X],
               state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y],
               state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER],
               state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER],
               0};
  for (unsigned button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; ++button)
    if (state.buttons[button] == GLFW_PRESS) now.buttons |= 1U << button;
  for (const Action action : pad_.step(now, input.elapsed_s, input.fly)) act(action);
  strikes_ += static_cast<int>(pad_.struck());
  input.strike_held = input.strike_held || pad_.holds_trigger();
}

bool AppWindow::minimised() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || width_ == 0 || height_ == 0;
}

std::pair<int, int> AppWindow::window_size() const {
  if (windowed_) return {windowed_->z, windowed_->w};
  std::pair<int, int> size;
  glfwGetWindowSize(window_, &size.first, &size.second);
  return size;
}

void AppWindow::show_frame() {
  if (minimised()) {
    // Swapping the buffers of a hidden window may not wait for the display.
    glfwWaitEventsTimeout(minimised_pause_s);
  } else {
    glfwSwapBuffers(window_);
  }
}

}  // namespace scree
