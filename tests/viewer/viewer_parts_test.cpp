// The parts of the viewer that need neither a window nor OpenGL.
#include <array>
#include <gtest/gtest.h>

#include "client/viewer/base/limits.h"
#include "client/viewer/input/actions.h"
#include "client/viewer/input/fly_camera.h"
#include "client/viewer/pictures/screenshots.h"
#include "client/viewer/session/sight.h"
#include "client/viewer/viewing/options.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

template <size_t N>
std::variant<ViewerOptions, ExitNow> parse(const std::array<const char*, N>& arguments) {
  return parse_options(static_cast<int>(N), arguments.data());
}

TEST(Actions, each_has_a_name_by_which_programs_know_it) {
  for (const Binding& binding : bindings())
    EXPECT_EQ(action_named(binding.name), binding.action) << binding.name;
  EXPECT_FALSE(action_named("dance"));
}

TEST(Screenshots, orders_are_understood_or_refused_by_name) {
  EXPECT_EQ(parse_screenshot("a.png")->when, ScreenshotOrder::When::joined);
  EXPECT_EQ(parse_screenshot("a.png@joined")->file, "a.png");
  EXPECT_EQ(parse_screenshot("a.png@settled")->when, ScreenshotOrder::When::settled);
  EXPECT_EQ(parse_screenshot("a.png@pieces>=40")->pieces, 40U);
  EXPECT_EQ(parse_screenshot("a.png@after=12")->seconds, 12U);
  EXPECT_EQ(parse_screenshot("a.png@after=12")->description(), "a.png@after=12");
  for (const char* bad : {"", "@joined", "a.png@", "a.png@soon", "a.png@pieces>=", "a.png@pieces>=0",
                          "a.png@pieces>=4x", "a.png@after=0", "a.png@after=", "a.png@after=99999999999",
                          "a.png@pieces>=-4", "a.jpg", "a", "a.png.jpg@joined"})
    EXPECT_FALSE(parse_screenshot(bad)) << bad;
}

TEST(Screenshots, each_waits_for_its_own_moment) {
  ScreenshotQueue queue({*parse_screenshot("1.png@joined"), *parse_screenshot("2.png@pieces>=5"),
                         *parse_screenshot("3.png@settled")});
  Moment moment;
  moment.current = true;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.joined = true;
  EXPECT_EQ(queue.pop_due(moment).at(0).file, "1.png");
  moment.joined = false;
  moment.now_s = 50.0;
  moment.pieces = 6;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.now_s += limits::flight_s + 0.01;
  EXPECT_TRUE(queue.pop_due(moment).empty()) << "pieces fly, but there is no terrain to see";
  moment.joined = true;
  moment.pieces = 0;
  moment.now_s = 100.0;
  EXPECT_TRUE(queue.pop_due(moment).empty()) << "settled, though nothing was ever carved";
  moment.pieces = 6;
  moment.carved = moment.alive = true;
  EXPECT_TRUE(queue.pop_due(moment).empty()) << "the pieces have had no time to fly";
  moment.now_s += limits::flight_s + 0.01;
  EXPECT_EQ(queue.pop_due(moment).at(0).file, "2.png");
  moment.pieces = 0;
  moment.alive = false;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.now_s += limits::settled_s + 0.01;
  EXPECT_EQ(queue.pop_due(moment).at(0).file, "3.png");
  EXPECT_TRUE(queue.empty());
}

TEST(Screenshots, one_is_taken_so_many_seconds_after_the_terrain_has_come) {
  ScreenshotQueue queue({*parse_screenshot("1.png@after=12")});
  Moment moment;
  moment.now_s = 100.0;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.joined = true;
  moment.now_s = 120.0;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.now_s = 131.9;
  EXPECT_TRUE(queue.pop_due(moment).empty());
  moment.now_s = 132.0;
  EXPECT_EQ(queue.pop_due(moment).at(0).file, "1.png");
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

TEST(FlyCamera, covers_its_way_at_three_frames_a_second_as_at_sixty) {
  FlyInput forward;
  forward.move.z = 1.0F;
  Camera slow, quick;
  for (int i = 0; i < 3; ++i) fly(slow, forward, 1.0F / 3.0F);
  for (int i = 0; i < 60; ++i) fly(quick, forward, 1.0F / 60.0F);
  EXPECT_NEAR(slow.eye_m.z, quick.eye_m.z, 0.01F);
  EXPECT_NEAR(quick.eye_m.z, -9.0F, 0.01F);
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
