// The viewer's window for tests, on an X server of the test's own that shows nothing to anyone (Xvfb), with a
// server to look at and a hand that presses keys (xdotool).
#pragma once

#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "client/viewer/window_app.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"

namespace scree {

/// The sizes at which panels are looked at.
inline const auto window_sizes =
    testing::Values(std::pair(640, 360), std::pair(960, 540), std::pair(1920, 1080));

/// An X server on a display that is free; ends with the object.
class VirtualScreen {
 public:
  VirtualScreen() {
    int ends[2];
    if (::pipe(ends) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
      ::close(ends[0]);
      const std::string descriptor = std::to_string(ends[1]);
      ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1920x1080x24", "-nolisten",
               "tcp", static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(ends[1]);
    char digit = 0;
    while (::read(ends[0], &digit, 1) == 1 && digit != '\n') display_ += digit;
    ::close(ends[0]);
    if (!display_.empty()) ::setenv("DISPLAY", (":" + display_).c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
  }
  ~VirtualScreen() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  bool runs() const { return !display_.empty(); }

 private:
  pid_t process_ = -1;
  std::string display_;
};

/// What breaks rock, where a person begins with digging.
inline Tool carving_tool() {
  Tool tool;
  take_up(tool, ToolUse::carve);
  return tool;
}

class ViewerWindow : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(screen_.runs()) << "Xvfb does not start (package xvfb)";
    LiveConfig config;
    config.net.port = 0;
    config.world.terrain.kind = TerrainKind::flat;
    prepare(config);
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    options_.host = "127.0.0.1";
    options_.port = server_->port();
    options_.view_radius_m = 12.0F;
    options_.given.view_radius = true;
    options_.camera.eye_m = {0.0F, 3.0F, 6.0F};
    options_.camera.pitch = -0.45F;
    options_.given.camera = true;
    options_.method = &all_methods().front();
    options_.gl_debug = true;
  }

  virtual void prepare(LiveConfig&) {}

  void open(int width, int height) {
    Result<std::unique_ptr<AppWindow>> window = AppWindow::open(width, height, true);
    ASSERT_TRUE(window) << window.error().message;
    window_ = std::move(*window);
    pin_libraries();
    Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options_);
    ASSERT_TRUE(viewing) << viewing.error().message;
    viewing_ = std::move(*viewing);
    app_ = std::make_unique<WindowApp>(*window_, *viewing_, settings_);
  }
  void TearDown() override {
    app_.reset();
    viewing_.reset();
    window_.reset();
  }

  template <typename Condition>
  void run_until(const Condition& condition, const char* what) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << what << " does not come";
      const Result<void> done = app_->frame();
      ASSERT_TRUE(done) << done.error().message;
    }
  }

  /// Everything is shown, and the tool breaks rock.
  static Settings all_of_the_hud() {
    Settings settings;
    settings.hud = {Telling::all, true, true, true};
    settings.overlay.shown = true;
    settings.tool = carving_tool();
    return settings;
  }

  VirtualScreen screen_;
  ViewerOptions options_;
  Settings settings_ = all_of_the_hud();
  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<AppWindow> window_;
  std::unique_ptr<Viewing> viewing_;
  std::unique_ptr<WindowApp> app_;
};

/// Sends keys and clicks to the window as a person's hand would. They arrive in order, some time later.
class ViewerHand : public ViewerWindow {
 protected:
  static void hand(const std::string& what) {
    ASSERT_EQ(std::system(("xdotool " + what).c_str()), 0) << "xdotool (package xdotool)";
  }
  bool shown(PanelPlace place) const { return app_->panels()[static_cast<size_t>(place)] != Rectangle{}; }
  void join(int width, int height) {
    open(width, height);
    run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
    hand("mousemove " + std::to_string(width / 2) + " " + std::to_string(height * 2 / 3));
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(app_->frame());
  }
  void expect_apart(int width, int height) {
    for (int frame = 0; frame < 4; ++frame) {
      frames(1);
      const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
      for (size_t i = 0; i < panel_places; ++i) {
        const Rectangle& one = app_->panels()[i];
        EXPECT_LE(one.at.x + one.size.x, size.x);
        EXPECT_LE(one.at.y + one.size.y, size.y);
        for (size_t j = 0; j < i; ++j) EXPECT_FALSE(intersect(one, app_->panels()[j])) << i << " and " << j;
      }
    }
  }
  /// Takes the mouse, with nothing on the screen that a click could meet.
  void capture_mouse() {
    hand("key p key h key g click 1");
    run_until([&] { return window_->holds_mouse() && !shown(PanelPlace::upper_right); }, "the mouse");
  }
};

}  // namespace scree
