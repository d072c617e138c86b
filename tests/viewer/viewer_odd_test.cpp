// Situations that a viewer meets sooner or later, and what it says then: no display, an OpenGL that is too
// old, a picture larger than the driver can make, a server that goes and comes back.
#include <gtest/gtest.h>
#include <thread>

#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/pictures/picture_difference.h"
#include "client/viewer/viewing/hud_facts.h"
#include "client/viewer/viewing/viewing.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"
#include "tests/support/raw_client.h"
#include "tests/support/run_viewer.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

TEST(ViewerOdd, no_display_is_said_with_the_way_out) {
  const auto [status, said] = run_viewer("-u DISPLAY -u WAYLAND_DISPLAY", "--port 1");
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("no window can be opened"), std::string::npos) << said;
  EXPECT_NE(said.find("--offscreen"), std::string::npos) << said;
}

TEST(ViewerOdd, an_opengl_that_is_too_old_is_said_with_the_way_out) {
  const auto [status, said] = run_viewer("MESA_GL_VERSION_OVERRIDE=2.1 MESA_GLES_VERSION_OVERRIDE=2.0",
                                         "--port 1 --offscreen --screenshot never.png");
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("OpenGL 3.3"), std::string::npos) << said;
  EXPECT_NE(said.find("libgl1-mesa-dri"), std::string::npos) << said;
}

TEST(ViewerOdd, no_driver_at_all_is_said_with_the_way_out) {
  const auto [status, said] = run_viewer("__EGL_VENDOR_LIBRARY_DIRS=/nowhere LIBGL_DRIVERS_PATH=/nowhere",
                                         "--port 1 --offscreen --screenshot never.png");
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("libgl1-mesa-dri"), std::string::npos) << said;
}

TEST(ViewerOdd, opengl_es_3_0_draws_too_and_says_which_methods_it_lacks) {
  const std::string es_only = "MESA_GL_VERSION_OVERRIDE=2.1 MESA_GLES_VERSION_OVERRIDE=3.0";
  for (const MethodEntry& entry : all_methods()) {
    // Nobody listens on port 1: what can be drawn at all waits for a server until the time is over.
    const auto [status, said] =
        run_viewer(es_only, "--port 1 --offscreen --screenshot never.png --timeout 0.2 --method " +
                                std::string(entry.name));
    EXPECT_EQ(status, 1);
    const bool waits = said.find("gave up") != std::string::npos;
    const bool names_what_it_lacks =
        said.find("--method") != std::string::npos || said.find("needs") != std::string::npos;
    EXPECT_TRUE(waits || names_what_it_lacks) << said;
    if (entry.name == "mesh") {
      EXPECT_TRUE(waits) << said;
    }
    if (entry.name == "grid") {
      EXPECT_NE(said.find("the method grid needs geometry shaders"), std::string::npos) << said;
    }
  }
}

TEST(ViewerOdd, grids_that_cannot_be_are_refused_by_name) {
  for (const std::string option : {"--grid-resolution 40", "--grid-resolution 0", "--grid-resolution 4096",
                                   "--grid-scale 3", "--grid-scale 64", "--grid-spacing shrinking"}) {
    const auto [status, said] = run_viewer("", "--port 1 --offscreen --screenshot never.png " + option);
    EXPECT_NE(status, 0) << option;
    EXPECT_NE(said.find(option.substr(0, option.find(' '))), std::string::npos) << said;
  }
}

/// A viewer without a window, and a server that comes and goes.
class ViewerOddSession : public testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<EglContext>> context = EglContext::create(true);
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    pin_libraries();
    start_server(0);
    options_.host = "127.0.0.1";
    options_.port = server_->port();
    options_.width = 96;
    options_.height = 64;
    options_.view_radius_m = 12.0F;
    options_.given.view_radius = true;
    options_.camera.eye_m = {0.0F, 3.0F, 6.0F};
    options_.camera.pitch = -0.45F;
    options_.given.camera = true;
    options_.method = &all_methods().front();
    options_.gl_debug = true;
    Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options_);
    ASSERT_TRUE(viewing) << viewing.error().message;
    viewing_ = std::move(*viewing);
  }

  void start_server(uint16_t port) {
    LiveConfig config;
    config.net.port = port;
    config.world.terrain.kind = TerrainKind::flat;
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }

  template <typename Condition>
  void step_until(const Condition& condition, const char* what) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << what << " does not come";
      const Result<void> stepped = viewing_->step(steady_now_s());
      ASSERT_TRUE(stepped) << stepped.error().message;
      std::this_thread::sleep_for(2ms);
    }
  }
  void step_until_joined() {
    step_until([&] { return viewing_->joined(steady_now_s()); }, "the world");
  }

  ViewerOptions options_;
  std::unique_ptr<EglContext> context_;
  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<Viewing> viewing_;
};

TEST_F(ViewerOddSession, last_field_stays_when_the_server_goes_and_the_viewer_comes_back_with_it) {
  step_until_joined();
  const Result<Image> before = viewing_->picture(steady_now_s());
  ASSERT_TRUE(before) << before.error().message;
  FactFinder facts;
  EXPECT_FALSE(facts.find(*viewing_, steady_now_s()).lost);

  server_.reset();
  step_until([&] { return !viewing_->session.connected(); }, "the loss");
  const HudFacts lost = facts.find(*viewing_, steady_now_s());
  EXPECT_TRUE(lost.lost) << "the banner is shown";
  EXPECT_NE(lost.connection.find("trying again"), std::string::npos) << lost.connection;
  const Result<Image> without = viewing_->picture(steady_now_s());
  ASSERT_TRUE(without);
  EXPECT_EQ(*picture_difference(*before, *without), 0.0);

  start_server(options_.port);
  step_until([&] { return viewing_->session.connected(); }, "the server");
  step_until_joined();
  EXPECT_FALSE(facts.find(*viewing_, steady_now_s()).lost);
  const Result<Image> again = viewing_->picture(steady_now_s());
  ASSERT_TRUE(again);
  EXPECT_EQ(*picture_difference(*before, *again), 0.0);
}

TEST_F(ViewerOddSession, figures_say_what_is_not_answered_and_how_long_the_last_answer_took) {
  step_until_joined();
  FactFinder facts;
  EXPECT_FALSE(facts.find(*viewing_, steady_now_s()).latency);
  Tool carves;
  take_up(carves, ToolUse::carve);
  viewing_->session.strike(carves, viewing_->camera.eye_m, viewing_->camera.forward(), steady_now_s());
  EXPECT_EQ(facts.find(*viewing_, steady_now_s()).predictions, 1U);
  step_until([&] { return viewing_->session.predictions() == 0; }, "the server's carve");
  const HudFacts answered = facts.find(*viewing_, steady_now_s());
  EXPECT_EQ(answered.predictions, 0U);
  ASSERT_TRUE(answered.latency);
  EXPECT_GT(answered.latency->server.tick_us, 0U);
  step_until([&] { return facts.find(*viewing_, steady_now_s()).status->latency != LatencyStatus{}; },
             "the status");
}

TEST_F(ViewerOddSession, what_one_viewer_kept_the_next_one_is_not_sent_again) {
  const TestFolder folder;
  options_.cache = {folder / "cache", size_t{1} << 24U};
  RawClient builder(server_->port());
  ASSERT_TRUE(builder.send(HelloMessage{protocol_version, "test", {}, 8.0F}));
  ASSERT_TRUE(builder.send(FillMessage{{sphere({}, 1.0F)}, 1}));
  ASSERT_TRUE(builder.receive_as<ReplyMessage>(patience));
  const auto count = [&] {
    viewing_.reset();
    viewing_ = std::move(*Viewing::begin(options_));
    const auto edits = [&] {
      Mirror* const mirror = viewing_->session.mirror();
      return mirror != nullptr && !mirror->held_chunks().empty();
    };
    step_until(edits, "the fill");
    step_until_joined();
    return viewing_->session.mirror()->counters();
  };
  const MirrorCounters first = count();
  EXPECT_GT(first.chunks, 0U);
  EXPECT_EQ(first.chunks_kept, 0U);
  const MirrorCounters second = count();
  EXPECT_EQ(second.chunks, 0U);
  EXPECT_EQ(second.chunks_kept, first.chunks);
  EXPECT_EQ(second.mismatches, 0U);
}

TEST_F(ViewerOddSession, pictures_of_one_pixel_and_of_8k_are_drawn_and_more_is_refused_by_name) {
  step_until_joined();
  Renderer& renderer = viewing_->view->renderer();
  DrawMethod& method = *viewing_->view->methods().shown();
  EXPECT_TRUE(renderer.draw_image(method, viewing_->camera, 1, 1));
  Camera up = viewing_->camera;
  up.pitch = 1.5F;  // sky alone: pixels that cost little
  const Result<Image> large = renderer.draw_image(method, up, 7680, 4320);
  ASSERT_TRUE(large) << large.error().message;
  EXPECT_EQ(large->rgb.size(), size_t{7680} * 4320 * 3);
  const Result<Image> too_large = renderer.draw_image(method, up, 1 << 20, 4);
  ASSERT_FALSE(too_large);
  EXPECT_NE(too_large.error().message.find("--size"), std::string::npos) << too_large.error().message;
  // The small one again, after the failure.
  EXPECT_TRUE(renderer.draw_image(method, viewing_->camera, 96, 64));
}

TEST_F(ViewerOddSession, a_minimised_window_draws_nothing_and_the_world_goes_on) {
  step_until_joined();
  const Tick tick = viewing_->session.mirror()->tick();
  viewing_->view->renderer().draw(viewing_->view->methods().shown(), viewing_->camera, 0, 0, 0);
  step_until([&] { return viewing_->session.mirror()->tick() > tick + 3; }, "the next tick");
  EXPECT_EQ(viewing_->view->renderer().gl_errors(), 0U) << viewing_->view->renderer().first_gl_error();
}

TEST_F(ViewerOddSession, camera_inside_rock_strikes_where_it_is) {
  step_until_joined();
  viewing_->camera.eye_m = {0.0F, -5.0F, 0.0F};
  EXPECT_TRUE(viewing_->picture(steady_now_s()));
  const auto hit_m = viewing_->session.aim(viewing_->camera.eye_m, viewing_->camera.forward());
  ASSERT_TRUE(hit_m);
  EXPECT_EQ(*hit_m, viewing_->camera.eye_m);
}

TEST_F(ViewerOddSession, lines_are_drawn_over_the_world_and_faintly_through_it) {
  step_until_joined();
  const Result<Image> before = viewing_->picture(steady_now_s());
  LineList lines;
  lines.box({-1.0F, -0.5F, -1.0F}, {1.0F, 1.0F, 1.0F}, {255, 0, 0, 255});
  const Result<Image> after = viewing_->view->renderer().draw_image(
      *viewing_->view->methods().shown(), viewing_->camera, options_.width, options_.height, lines);
  ASSERT_TRUE(before && after);
  EXPECT_GT(*picture_difference(*before, *after), 0.005);
  EXPECT_EQ(viewing_->view->renderer().gl_errors(), 0U) << viewing_->view->renderer().first_gl_error();
}

}  // namespace
}  // namespace scree
