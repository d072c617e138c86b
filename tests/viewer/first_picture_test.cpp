// The first picture of who says no camera: on each ground and each scene it has ground and sky in it, nothing
// right before the eye, and no rock around it. SCREE_PICTURES names a folder for the pictures, for people.
#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>
#include <thread>

#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/pictures/png.h"
#include "client/viewer/viewing/viewing.h"
#include "server/app/live_server.h"
#include "server/world/spawn_place.h"
#include "shared/base/timing.h"
#include "tests/support/flat_world.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"
#include "tools/scenes/build.h"

namespace scree {
namespace {

constexpr int picture_width = 240, picture_height = 135;

class FirstPicture : public testing::Test {
 protected:
  void SetUp() override {
    auto context = EglContext::create(true);
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    pin_libraries();
  }
  void TearDown() override {
    viewing_.reset();
    server_.reset();
  }

  void serve(LiveConfig config) {
    config.net.port = port_;
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    port_ = server_->port();
  }
  /// `more`: arguments of the viewer.
  void view(std::vector<std::string> more = {}) {
    std::vector<std::string> texts{"scree-viewer",     "--port=" + std::to_string(port_),
                                   "--offscreen",      "--cache-mib=0",
                                   "--quality=low",    "--view-radius=48",
                                   "--size=240x135",   "--screenshot=" + (folder_ / "unused.png"),
                                   "--particles=false"};
    texts.insert(texts.end(), more.begin(), more.end());
    std::vector<const char*> argv;
    for (const std::string& text : texts) argv.push_back(text.c_str());
    auto parsed = parse_options(static_cast<int>(argv.size()), argv.data());
    ASSERT_TRUE(std::holds_alternative<ViewerOptions>(parsed));
    options_ = std::move(std::get<ViewerOptions>(parsed));
    auto viewing = Viewing::begin(options_);
    ASSERT_TRUE(viewing) << viewing.error().message;
    viewing_ = std::move(*viewing);
  }
  /// Steps until it holds; false after the deadline.
  template <typename Condition>
  bool step_until(const Condition& condition) {
    const double end_s = steady_now_s() + 3.0 * std::chrono::duration<double>(patience).count();
    while (steady_now_s() < end_s) {
      if (!viewing_->step(steady_now_s())) return false;
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  bool load() {
    return step_until(
        [&] { return viewing_->joined(steady_now_s()) && viewing_->view->methods().complete(); });
  }
  void keep_picture(const std::string& name) {
    const char* const folder = std::getenv("SCREE_PICTURES");
    if (folder == nullptr) return;
    const auto image = viewing_->picture(steady_now_s(), 640, 360);
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_TRUE(write_png(std::string(folder) + "/" + name + ".png", *image));
  }

  void expect_a_good_picture(const std::string& name);

  TestFolder folder_;
  uint16_t port_ = 0;
  std::unique_ptr<EglContext> context_;
  std::unique_ptr<LiveServer> server_;
  ViewerOptions options_;
  std::unique_ptr<Viewing> viewing_;
};

void FirstPicture::expect_a_good_picture(const std::string& name) {
  SCOPED_TRACE(name);
  view();
  ASSERT_TRUE(load()) << viewing_->session.description();
  keep_picture(name);
  const Camera& camera = viewing_->camera;
  const Spawn here{camera.eye_m, 0.0F, 0.0F};
  EXPECT_EQ(lifted(viewing_->session.field(), here), here) << "no rock is around the eye";
  auto& view = *viewing_->view;
  const auto depths =
      view.renderer().draw_depths(*view.methods().shown(), camera, picture_width, picture_height);
  ASSERT_TRUE(depths) << depths.error().message;
  size_t sky = 0, near = 0;
  for (const float metres : depths->metres) {
    sky += std::isinf(metres) ? 1 : 0;
    near += metres < 1.5F ? 1 : 0;
  }
  const size_t all = depths->metres.size();
  EXPECT_GT(sky, all / 16) << "the horizon is in the picture";
  EXPECT_LT(sky, all * 7 / 10) << "and so is the world";
  EXPECT_LT(near, all / 50) << "nothing is right before the eye";
  const auto image = viewing_->picture(steady_now_s(), picture_width, picture_height);
  ASSERT_TRUE(image) << image.error().message;
  std::set<std::array<uint8_t, 3>> colours;
  for (size_t i = 0; i + 2 < image->rgb.size(); i += 3)
    colours.insert({image->rgb[i], image->rgb[i + 1], image->rgb[i + 2]});
  EXPECT_GT(colours.size(), 60U) << "there is something to see";
}

TEST_F(FirstPicture, of_every_generated_ground) {
  for (const TerrainKind kind : all_kinds<TerrainKind>) {
    LiveConfig config;
    config.world.terrain.kind = kind;
    serve(config);
    expect_a_good_picture("ground_" + std::string(name_of(kind)));
    viewing_.reset();
    server_.reset();
    port_ = 0;
  }
}

TEST_F(FirstPicture, of_every_scene) {
  for (const SceneRow& row : all_scenes()) {
    SCOPED_TRACE(row.name);
    const auto scene = row.set_up(folder_ / "");
    ASSERT_TRUE(scene) << scene.error().message;
    LiveConfig config;
    config.world_path = folder_ / (std::string(row.name) + ".world");
    const auto made = make_scene_file(*scene, config.world_path, 7);
    ASSERT_TRUE(made) << made.error().message;
    serve(config);
    expect_a_good_picture("scene_" + std::string(row.name));
    EXPECT_LT(glm::distance(viewing_->camera.eye_m, scene->eye_m), 0.1F);
    viewing_.reset();
    server_.reset();
    port_ = 0;
  }
}

TEST_F(FirstPicture, shows_the_props_of_a_server) {
  const auto scene = scene_named("store")->set_up(folder_ / "");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto is_prop = [](const BuildStep& step) { return std::holds_alternative<AddPropRequest>(step); };
  const auto props = static_cast<size_t>(std::ranges::count_if(scene->build, is_prop));
  LiveConfig config;
  config.world_path = folder_ / "store.world";
  ASSERT_TRUE(make_scene_file(*scene, config.world_path, 7));
  serve(config);
  view();
  ASSERT_TRUE(load()) << viewing_->session.description();
  ASSERT_EQ(viewing_->session.mirror()->props().size(), props);
  const auto shown = viewing_->picture(steady_now_s(), picture_width, picture_height);
  ASSERT_TRUE(viewing_->view->renderer().set_props({}));
  const auto bare = viewing_->picture(steady_now_s(), picture_width, picture_height);
  ASSERT_TRUE(shown && bare);
  size_t changed = 0;
  for (size_t i = 0; i < shown->rgb.size(); i += 3)
    changed += std::abs(shown->rgb[i] - bare->rgb[i]) > 16 ? 1 : 0;
  EXPECT_GT(changed, 500U);
}

TEST_F(FirstPicture, of_an_imported_ground_without_a_scene) {
  const auto scene = scene_named("city")->set_up(folder_ / "");
  ASSERT_TRUE(scene) << scene.error().message;
  LiveConfig config;
  config.world = scene->config;
  config.world_path = folder_ / "plain.world";
  serve(config);
  expect_a_good_picture("ground_city");
}

TEST_F(FirstPicture, a_camera_that_is_said_wins) {
  LiveConfig config;
  config.world = flat_world();
  serve(config);
  view({"--camera=1,7,3,20,-15"});
  ASSERT_TRUE(step_until([&] { return viewing_->session.connected(); }));
  EXPECT_EQ(viewing_->camera.eye_m, glm::vec3(1.0F, 7.0F, 3.0F));
}

TEST_F(FirstPicture, who_comes_back_stays_where_they_are) {
  LiveConfig config;
  config.world = flat_world();
  config.world.spawn = Spawn{{4.0F, 3.0F, 5.0F}, 40.0F, -5.0F};
  serve(config);
  view();
  ASSERT_TRUE(step_until([&] { return viewing_->session.connected(); }));
  EXPECT_EQ(viewing_->camera.eye_m, config.world.spawn->eye_m);
  viewing_->camera.eye_m = {-2.0F, 6.0F, 1.0F};
  server_.reset();
  ASSERT_TRUE(step_until([&] { return !viewing_->session.connected(); }));
  config.world.spawn = Spawn{{9.0F, 9.0F, 9.0F}, 0.0F, 0.0F};
  serve(config);
  ASSERT_TRUE(step_until([&] { return viewing_->session.connected(); }));
  EXPECT_EQ(viewing_->session.welcome()->spawn, config.world.spawn);
  EXPECT_EQ(viewing_->camera.eye_m, glm::vec3(-2.0F, 6.0F, 1.0F));
}

}  // namespace
}  // namespace scree
