// The viewer's window, on an X server of the test's own that shows nothing to anyone (Xvfb).
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "client/viewer/pictures/png.h"
#include "client/viewer/window_app.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"
#include "tests/support/run_viewer.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

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

class ViewerWindow : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(screen_.runs()) << "Xvfb does not start (package xvfb)";
    LiveConfig config;
    config.net.port = 0;
    config.world.terrain.kind = TerrainKind::flat;
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    options_.host = "127.0.0.1";
    options_.port = server_->port();
    options_.view_radius_m = 12.0F;
    options_.given.view_radius = true;
    options_.camera.eye_m = {0.0F, 3.0F, 6.0F};
    options_.camera.pitch = -0.45F;
    options_.method = &all_methods().front();
    options_.gl_debug = true;
  }

  void open(int width, int height) {
    Result<std::unique_ptr<AppWindow>> window = AppWindow::open(width, height, true);
    ASSERT_TRUE(window) << window.error().message;
    window_ = std::move(*window);
    keep_libraries_loaded();
    Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options_);
    ASSERT_TRUE(viewing) << viewing.error().message;
    viewing_ = std::move(*viewing);
    Settings settings;
    settings.hud = {Telling::all, true, true, true};
    settings.overlay.shown = true;
    app_ = std::make_unique<WindowApp>(*window_, *viewing_, settings);
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

  VirtualScreen screen_;
  ViewerOptions options_;
  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<AppWindow> window_;
  std::unique_ptr<Viewing> viewing_;
  std::unique_ptr<WindowApp> app_;
};

TEST_F(ViewerWindow, draws_with_all_of_the_hud_and_goes_on_without_a_server) {
  open(320, 200);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
  EXPECT_EQ(app_->settings().width, 320);
  EXPECT_EQ(app_->settings().method, options_.method->name);
  server_.reset();
  run_until([&] { return !viewing_->session.connected(); }, "the loss");
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(app_->frame());
  EXPECT_NE(viewing_->view->methods().shown(), nullptr) << "the last field stays";
}

TEST_F(ViewerWindow, shows_what_the_servers_bodies_do_when_the_overlay_asks) {
  open(320, 200);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
  viewing_->session.strike(Tool{}, viewing_->camera.eye_m, viewing_->camera.forward(), steady_now_s());
  run_until(
      [&] {
        const PhysicsMessage* physics = viewing_->session.physics();
        return physics != nullptr && !physics->bodies.empty();
      },
      "what the bodies do");
  LineList lines;
  OverlayChoice choice;
  viewing_->add_overlay(lines, choice, steady_now_s());
  EXPECT_TRUE(lines.vertices().empty()) << "nothing is shown that was not asked for";
}

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
  /// Takes the mouse, with nothing on the screen that a click could meet.
  void take_mouse() {
    hand("key p key h key g click 1");
    run_until([&] { return window_->holds_mouse() && !shown(PanelPlace::bottom); },
              "the mouse, and nothing to be said any more");
  }
};

TEST_F(ViewerHand, shows_hides_asks_and_ends_by_keys) {
  join(640, 360);
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && shown(PanelPlace::lower_left) &&
               shown(PanelPlace::upper_right) && shown(PanelPlace::lower_right) && shown(PanelPlace::bottom);
      },
      "everything");
  for (size_t i = 0; i < panel_places; ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(intersect(app_->panels()[i], app_->panels()[j]));
  hand("key F1");
  run_until([&] { return app_->panels() == PanelRectangles{}; }, "the picture alone");
  hand("key Escape");
  run_until([&] { return window_->asks_to_end() && shown(PanelPlace::bottom); },
            "the question, seen all the same");
  hand("key m");
  run_until([&] { return !window_->asks_to_end(); }, "no");
  EXPECT_FALSE(window_->should_close());
  hand("key F1 key g key p key h");
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && !shown(PanelPlace::lower_right) &&
               !shown(PanelPlace::upper_right) && !shown(PanelPlace::lower_left);
      },
      "figures alone: after all the help comes none");
  EXPECT_EQ(app_->settings().method, options_.method->name) << "the key that said no did nothing else";
  hand("key Escape key Return");
  run_until([&] { return window_->should_close(); }, "the end");
}

TEST_F(ViewerHand, the_first_click_takes_the_mouse_and_the_second_strikes) {
  join(320, 200);
  take_mouse();
  EXPECT_FALSE(viewing_->session.carved());
  hand("click 1");
  run_until([&] { return viewing_->session.carved(); }, "what the strike broke");
  const HandChoice before = app_->settings().hand;
  hand("key Prior key comma key Tab");
  run_until([&] { return !window_->holds_mouse(); }, "the mouse's freedom");
  EXPECT_GT(app_->settings().hand.text_scale, before.text_scale);
  EXPECT_LT(app_->settings().hand.field_of_view_degrees, before.field_of_view_degrees);
}

TEST_F(ViewerHand, fills_and_paints) {
  join(320, 200);
  take_mouse();
  const auto poured = [&] {
    const auto& status = viewing_->session.mirror()->status();
    return status && status->ledger_poured > 0;
  };
  hand("key f click 1");
  run_until(poured, "what was poured");
  const auto painted = [&] {
    Field& field = viewing_->session.mirror()->field();
    for (const ChunkCoord chunk : field.edited_chunks())
      for (const BrickCoord brick : field.edited_bricks(chunk))
        if (field.painted(brick) == app_->settings().tool.material) return true;
    return false;
  };
  hand("key f key b click 1");
  run_until(painted, "what was painted");
  EXPECT_EQ(app_->settings().tool.use, ToolUse::paint);
  EXPECT_FALSE(viewing_->session.carved());
}

TEST_F(ViewerHand, walks_and_is_stopped_by_a_wall) {
  join(320, 200);
  take_mouse();
  // A box stands on what it is aimed at.
  const Tool box{.kind = ToolKind::box, .use = ToolUse::fill, .radius_m = 2.0F};
  viewing_->session.strike(box, {0.0F, 6.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, steady_now_s());
  hand("key q");
  const float ground_m = ground_height_m(viewing_->session.mirror()->terrain(), 0.0F, 6.0F);
  const glm::vec3& eye_m = viewing_->camera.eye_m;
  run_until([&] { return std::abs(eye_m.y - ground_m - Walker::eye_above_m) < 0.2F; }, "the ground");
  hand("keydown w");
  run_until([&] { return eye_m.z < 2.6F; }, "the box");
  const double until_s = steady_now_s() + 0.5;
  run_until([&] { return steady_now_s() > until_s; }, "some more steps against it");
  hand("keyup w");
  EXPECT_GT(eye_m.z, 2.0F) << "the box stands in the way";
  hand("key q");
  run_until([&] { return app_->flies(); }, "wings");
}

TEST_F(ViewerHand, says_a_line_and_lists_who_is_there) {
  join(640, 360);
  const auto& conversation = viewing_->session.conversation();
  run_until([&] { return !conversation.persons().persons.empty(); }, "the list of persons");
  hand("key p key h key g key l");
  run_until([&] { return shown(PanelPlace::lower_right) && !shown(PanelPlace::upper_right); }, "the list");
  const glm::vec3 before_m = viewing_->camera.eye_m;
  hand("key Return type 'wasd m'");
  run_until([&] { return window_->writes() && window_->writes()->text() == "wasd m"; }, "what is written");
  EXPECT_EQ(viewing_->camera.eye_m, before_m) << "letters move nothing";
  EXPECT_EQ(app_->settings().method, options_.method->name) << "nor do they change anything";
  hand("key Return");
  run_until([&] { return !conversation.lines(steady_now_s(), true).empty(); }, "the line");
  EXPECT_FALSE(window_->writes());
  EXPECT_NE(conversation.lines(steady_now_s(), true)[0].find("wasd m"), std::string::npos);
}

class ViewerPanels : public ViewerHand, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(ViewerPanels, do_not_overlap_while_all_of_them_are_shown_and_a_line_is_written) {
  const auto [width, height] = GetParam();
  options_.quality = Quality::low;
  join(width, height);
  hand("key l key Return type 'a line that is written while everything is shown'");
  run_until(
      [&] {
        return shown(PanelPlace::upper_left) && shown(PanelPlace::lower_left) &&
               shown(PanelPlace::upper_right) && shown(PanelPlace::lower_right) &&
               shown(PanelPlace::bottom) && window_->writes();
      },
      "everything");
  for (int frame = 0; frame < 4; ++frame) {
    ASSERT_TRUE(app_->frame());
    const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
    for (size_t i = 0; i < panel_places; ++i) {
      const Rectangle& one = app_->panels()[i];
      EXPECT_LE(one.at.x + one.size.x, size.x);
      EXPECT_LE(one.at.y + one.size.y, size.y);
      for (size_t j = 0; j < i; ++j) EXPECT_FALSE(intersect(one, app_->panels()[j])) << i << " and " << j;
    }
  }
  hand("key Escape key F1");
  run_until([&] { return app_->panels() == PanelRectangles{}; }, "the picture alone");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ViewerPanels,
                         testing::Values(std::pair(640, 360), std::pair(960, 540), std::pair(1920, 1080)));

TEST_F(ViewerHand, takes_pictures_and_records_paths_into_this_folder) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "scree_hand", before = fs::current_path();
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::current_path(folder);
  const auto file = [&](const char* ending) {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ending) return entry.path().string();
    return std::string();
  };
  join(320, 200);
  hand("key F12 key k key k");
  run_until([&] { return !file(".json").empty(); }, "the path's file");
  fs::current_path(before);
  EXPECT_TRUE(read_png(file(".png")));
  EXPECT_TRUE(CameraPath::read(file(".json")));
  fs::remove_all(folder);
}

TEST_F(ViewerWindow, opengl_that_is_too_old_is_said_with_the_way_out) {
  const auto [status, said] =
      run_viewer("MESA_GL_VERSION_OVERRIDE=2.1 MESA_GLES_VERSION_OVERRIDE=2.0", "--port 1");
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("OpenGL 3.3"), std::string::npos) << said;
  EXPECT_NE(said.find("libgl1-mesa-dri"), std::string::npos) << said;
}

TEST_F(ViewerWindow, may_be_one_pixel) {
  open(1, 1);
  run_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
}

}  // namespace
}  // namespace scree
