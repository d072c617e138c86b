// The parts of the viewer that need neither a window nor OpenGL.
#include <array>
#include <gtest/gtest.h>

#include "client/viewer/base/limits.h"
#include "client/viewer/input/actions.h"
#include "client/viewer/input/fly_camera.h"
#include "client/viewer/pictures/screenshots.h"
#include "client/viewer/session/playback.h"
#include "client/viewer/session/sight.h"
#include "client/viewer/viewing/options.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

FrameMessage frame(Tick tick) {
  FrameMessage message;
  message.tick = tick;
  return message;
}

Tick tick_of(const ServerMessage& message) {
  return std::get<FrameMessage>(message).tick;
}

template <size_t N>
std::variant<ViewerOptions, ExitNow> parse(const std::array<const char*, N>& arguments) {
  return parse_options(static_cast<int>(N), arguments.data());
}

TEST(Playback, frames_wait_for_the_clock_and_keep_their_order) {
  Playback playback;
  playback.start(WelcomeMessage{});
  const double start_s = 1000.0;
  for (Tick tick = 1; tick <= 30; ++tick)
    playback.push(frame(tick), start_s + static_cast<double>(tick) / 60.0);
  const double now_s = start_s + 30.0 / 60.0;
  const std::vector<ServerMessage> due = playback.take_due(now_s);
  ASSERT_FALSE(due.empty());
  for (size_t i = 0; i < due.size(); ++i) EXPECT_EQ(tick_of(due[i]), i + 1);
  // 100 ms behind, of which the interval of the transforms is part.
  EXPECT_NEAR(static_cast<double>(due.size()), 30.0 - (limits::playback_delay_s * 60.0 - 3.0), 1.01);
  EXPECT_NEAR(playback.draw_tick(now_s), 30.0 - limits::playback_delay_s * 60.0, 0.01);
  EXPECT_EQ(playback.take_due(now_s + 1.0).size(), 30 - due.size());
}

TEST(Playback, what_comes_behind_a_frame_waits_with_it) {
  Playback playback;
  playback.start(WelcomeMessage{});
  playback.push(frame(60), 10.0);
  playback.push(StatusMessage{}, 10.0);
  EXPECT_TRUE(playback.take_due(10.0).empty());
  EXPECT_EQ(playback.take_due(10.2).size(), 2U);
}

TEST(Actions, each_has_a_name_by_which_programs_know_it) {
  for (const Binding& binding : bindings())
    EXPECT_EQ(action_named(binding.name), binding.action) << binding.name;
  EXPECT_FALSE(action_named("dance"));
}

TEST(Playback, messages_are_taken_one_by_one_as_well) {
  Playback playback;
  playback.start(WelcomeMessage{});
  playback.push(ChunkMessage{}, 10.0);
  playback.push(frame(60), 10.0);
  ASSERT_TRUE(playback.take_next(10.0));
  EXPECT_FALSE(playback.take_next(10.0)) << "the frame is not due";
  playback.push(frame(61), 10.0);
  EXPECT_EQ(tick_of(*playback.take_next(11.0)), 60U);
  EXPECT_EQ(tick_of(*playback.take_next(11.0)), 61U);
  EXPECT_FALSE(playback.take_next(11.0));
}

TEST(Playback, chunks_of_a_join_pass_at_once) {
  Playback playback;
  playback.start(WelcomeMessage{});
  playback.push(ChunkMessage{}, 5.0);
  EXPECT_EQ(playback.take_due(5.0).size(), 1U);
}

TEST(Playback, clock_never_runs_backwards_nor_on_without_frames_for_long) {
  Playback playback;
  playback.start(WelcomeMessage{});
  double last = -10.0;
  for (Tick tick = 1; tick <= 200; ++tick) {
    const double jitter_s = tick % 7 == 0 ? 0.08 : 0.0;
    const double now_s = 50.0 + static_cast<double>(tick) / 60.0 + jitter_s;
    playback.push(frame(tick), now_s);
    playback.take_due(now_s);
    const double draw = playback.draw_tick(now_s);
    EXPECT_GE(draw, last);
    EXPECT_LE(draw, static_cast<double>(tick));
    last = draw;
  }
  EXPECT_LE(playback.draw_tick(1000.0), 200.0 + limits::playback_quiet_s * 60.0);
}

TEST(Playback, holds_no_more_messages_back_than_its_limit) {
  Playback playback;
  playback.start(WelcomeMessage{});
  playback.push(frame(60), 10.0);
  for (size_t i = 1; i < limits::playback_messages_max; ++i) playback.push(StatusMessage{}, 10.0);
  EXPECT_TRUE(playback.take_due(10.0).empty()) << "all wait behind the frame";
  playback.push(StatusMessage{}, 10.0);
  EXPECT_EQ(playback.take_due(10.0).size(), limits::playback_messages_max + 1);
}

TEST(Playback, goes_on_after_a_jump_of_the_server) {
  Playback playback;
  playback.start(WelcomeMessage{});
  playback.push(frame(10000), 1.0);
  EXPECT_EQ(playback.take_due(1.5).size(), 1U);
  playback.push(frame(20), 2.0);
  EXPECT_EQ(playback.take_due(2.5).size(), 1U);
}

TEST(Screenshots, orders_are_understood_or_refused_by_name) {
  EXPECT_EQ(parse_screenshot("a.png")->when, ScreenshotOrder::When::joined);
  EXPECT_EQ(parse_screenshot("a.png@joined")->file, "a.png");
  EXPECT_EQ(parse_screenshot("a.png@settled")->when, ScreenshotOrder::When::settled);
  EXPECT_EQ(parse_screenshot("a.png@pieces>=40")->pieces, 40U);
  for (const char* bad : {"", "@joined", "a.png@", "a.png@soon", "a.png@pieces>=", "a.png@pieces>=0",
                          "a.png@pieces>=4x", "a.png@pieces>=-4", "a.jpg", "a", "a.png.jpg@joined"})
    EXPECT_FALSE(parse_screenshot(bad)) << bad;
}

TEST(Screenshots, each_waits_for_its_own_moment) {
  ScreenshotQueue queue({*parse_screenshot("1.png@joined"), *parse_screenshot("2.png@pieces>=5"),
                         *parse_screenshot("3.png@settled")});
  Moment moment;
  moment.current = true;
  EXPECT_TRUE(queue.take_due(moment).empty());
  moment.joined = true;
  EXPECT_EQ(queue.take_due(moment).at(0).file, "1.png");
  moment.now_s = 100.0;
  EXPECT_TRUE(queue.take_due(moment).empty()) << "settled, though nothing was ever carved";
  moment.pieces = 6;
  moment.carved = moment.alive = true;
  EXPECT_TRUE(queue.take_due(moment).empty()) << "the pieces have had no time to fly";
  moment.now_s += limits::flight_s + 0.01;
  EXPECT_EQ(queue.take_due(moment).at(0).file, "2.png");
  moment.pieces = 0;
  moment.alive = false;
  EXPECT_TRUE(queue.take_due(moment).empty());
  moment.now_s += limits::settled_s + 0.01;
  EXPECT_EQ(queue.take_due(moment).at(0).file, "3.png");
  EXPECT_TRUE(queue.empty());
}

TEST(Options, are_understood) {
  const auto parsed =
      parse(std::array{"scree-viewer", "--port", "4000", "--size", "320x200", "--camera", "1,2,3,90,-10",
                       "--method", "mesh", "--offscreen", "--screenshot", "a.png", "--screenshot",
                       "b.png@settled", "--predict", "false", "--particles", "false"});
  ASSERT_TRUE(std::holds_alternative<ViewerOptions>(parsed));
  const auto& options = std::get<ViewerOptions>(parsed);
  EXPECT_EQ(options.port, 4000);
  EXPECT_EQ(options.method->name, "mesh");
  EXPECT_EQ(options.width, 320);
  EXPECT_EQ(options.screenshots.size(), 2U);
  EXPECT_FALSE(options.predict);
  EXPECT_TRUE(options.given.predict);
  EXPECT_FALSE(options.particles);
  EXPECT_TRUE(options.given.particles);
  EXPECT_NEAR(options.camera.forward().x, -0.985F, 0.01F);
}

TEST(Options, nonsense_is_refused) {
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--size", "big"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--size", "99999x10"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--camera", "1,2,nan,0,0"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--camera", "1e9,2,3,0,0"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--view-radius", "100000"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--offscreen"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--method", "crayon"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--predict", "maybe"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--particles", "some"})).status, 2);
  EXPECT_EQ(std::get<ExitNow>(parse(std::array{"v", "--help"})).status, 0);
}

TEST(Sight, rock_hides_pieces_and_so_does_the_edge_of_the_picture) {
  MapField field(flat_terrain);
  Camera camera;
  camera.eye_m = {0.0F, 2.0F, 0.0F};
  const auto seen_at = [&](glm::vec3 place_m) {
    const ScenePieces pieces{{1, {nullptr, Pose{place_m, {}}}}};
    return pieces_in_sight(Scene{field, pieces}, camera, 1.5F, 50.0F) == 1;
  };
  EXPECT_TRUE(seen_at({0.0F, 1.5F, -10.0F}));
  EXPECT_TRUE(seen_at({0.0F, 0.1F, -10.0F})) << "lies on the ground";
  EXPECT_FALSE(seen_at({0.0F, -1.5F, -10.0F})) << "under the ground";
  EXPECT_FALSE(seen_at({0.0F, 1.5F, 10.0F})) << "behind the camera";
  EXPECT_FALSE(seen_at({0.0F, 1.5F, -80.0F})) << "too far";
}

TEST(FlyCamera, moves_where_it_looks_and_stays_in_the_world) {
  Camera camera;
  FlyInput forward;
  forward.move.z = 1.0F;
  fly(camera, forward, 0.1F);
  EXPECT_LT(camera.eye_m.z, -0.5F);
  forward.fast = true;
  camera.eye_m.z = -limits::world_half_width_m;
  fly(camera, forward, 0.1F);
  EXPECT_EQ(camera.eye_m.z, -limits::world_half_width_m);
}

}  // namespace
}  // namespace scree
