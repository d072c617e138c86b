// A game's signs in the pictures of the viewer without a window, and what else the rules tell a viewer.
#include <filesystem>
#include <gtest/gtest.h>

#include "client/cache/join_server.h"
#include "client/viewer/app.h"
#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/pictures/png.h"
#include "client/viewer/viewing/visit.h"
#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/offscreen_fixture.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class ViewerSigns : public testing::Test {
 protected:
  void SetUp() override {
    {
      const auto context = EglContext::create(false);
      ASSERT_TRUE(context) << context.error().message;
      pin_libraries();
    }
    LiveConfig config;
    config.world = flat_world();
    config.hooks.heard = [this](uint64_t, const ChannelData& data) {
      const std::scoped_lock lock(mutex_);
      heard_.push_back(data);
    };
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }

  void act(RulesAct act) { EXPECT_TRUE(server_->push({0, 0, RulesRequest{std::move(act)}})); }
  void show(Sign sign) { act(ShowSign{std::move(sign)}); }

  Image picture(const std::string& name) {
    const std::string file = (folder_ / name);
    const std::string port = "--port=" + std::to_string(server_->port()), shot = "--screenshot=" + file;
    const std::array argv{"scree-viewer",     port.c_str(),       shot.c_str(),
                          "--size=640x360",   "--view-radius=12", "--camera=0,3,6,0,-25",
                          "--offscreen=true", "--cache-mib=0",    "--details=false"};
    const auto parsed = parse_options(static_cast<int>(argv.size()), argv.data());
    EXPECT_EQ(run_offscreen(std::get<ViewerOptions>(parsed)), 0);
    const auto image = read_png(file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? *image : Image{};
  }

  /// A visit that goes on until the condition holds.
  std::unique_ptr<Visit> visit(const std::function<bool(Visit&)>& holds) {
    context_.reset();  // its end leaves no context current
    auto context = EglContext::create(false);
    EXPECT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    ServerEndpoint endpoint;
    endpoint.host = "127.0.0.1";
    endpoint.port = server_->port();
    auto view = View::create(*method_named("mesh"), 12.0F);
    EXPECT_TRUE(view) << view.error().message;
    VisitChoice choice;
    choice.view_radius_m = 12.0F;
    auto made = std::make_unique<Visit>(std::make_unique<ServerConnector>(endpoint), SessionChoice{12.0F},
                                        choice, std::move(*view));
    made->listen(true);
    static_cast<void>(made->drain_heard());
    const double until_s = steady_now_s() + 60.0;
    while (steady_now_s() < until_s) {
      EXPECT_TRUE(made->step(steady_now_s()));
      if (holds(*made)) return made;
      wait_a_moment();
    }
    ADD_FAILURE() << "it never holds";
    return made;
  }

  const TestFolder folder_;
  std::unique_ptr<EglContext> context_;
  std::mutex mutex_;
  std::vector<ChannelData> heard_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(ViewerSigns, screenshots_have_signs_where_a_game_shows_some_and_else_nothing) {
  const Image none = picture("none.png");
  EXPECT_EQ(differing_pixels(none, picture("again.png"), 0), 0U);
  Sign bar{.name = "a", .kind = SignKind::bar, .text = "12 of 40 t"};
  bar.share = 0.3F;
  bar.colour = {255, 90, 20};
  Sign place{.name = "b", .kind = SignKind::marker, .text = "dig here"};
  place.place_m = {0.0F, 0.5F, 0.0F};
  show(bar);
  show(place);
  {  // its context is gone before the viewer makes its own
    const auto visited = visit(
        [](Visit& v) { return v.session.mirror() != nullptr && v.session.mirror()->signs().size() == 2; });
    EXPECT_EQ(visited->signs(1.0F, steady_now_s()).size(), 2U);
  }
  const Image both = picture("both.png");
  if (const char* const kept = std::getenv("SCREE_PICTURES")) {
    EXPECT_TRUE(write_png(std::string(kept) + "/viewer_signs.png", both));
  }
  EXPECT_GT(differing_pixels(none, both, 12), 800U);
  act(RemoveSign{{}, "a"});
  act(RemoveSign{{}, "b"});
  visit([](Visit& v) {
    return v.session.mirror() != nullptr && v.session.joined(steady_now_s()) &&
           v.session.mirror()->signs().empty();
  });
  EXPECT_EQ(differing_pixels(none, picture("gone.png"), 0), 0U);
}

TEST_F(ViewerSigns, cues_lines_and_messages_come_to_a_viewer_and_it_answers) {
  const Cue cue{CueKind::crack, {0.0F, 1.0F, 0.0F}, 1.5F, 2e4F, material::rock};
  const auto visited = visit([](Visit& v) { return v.session.mirror() != nullptr; });
  act(Notice{{}, cue});
  act(Notice{{}, NoticeLine{"the tower falls"}});
  act(Notice{{}, ChannelData{"shop", {'h', 'i'}}});
  bool cracked = false, told = false;
  std::deque<ChannelData> heard;
  const double until_s = steady_now_s() + 60.0;
  while (!(cracked && told && !heard.empty()) && steady_now_s() < until_s) {
    ASSERT_TRUE(visited->step(steady_now_s()));
    cracked = cracked || std::ranges::any_of(visited->events(), [](const PieceEvent& event) {
                return event.kind == PieceEventKind::snap && event.size_m == 1.5F;
              });
    const auto lines = visited->session.conversation().lines(steady_now_s(), true);
    told = told || std::ranges::find(lines, "server: the tower falls") != lines.end();
    if (heard.empty()) heard = visited->drain_heard();
    wait_a_moment();
  }
  EXPECT_TRUE(cracked && told);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard.front(), (ChannelData{"shop", {'h', 'i'}}));
  EXPECT_FALSE(visited->session.send({"", {1}}));
  EXPECT_FALSE(visited->session.send({"shop", std::vector<uint8_t>(limits::channel_data_bytes_max + 1)}));
  ASSERT_TRUE(visited->session.send({"shop", {0, 255}}));
  const auto has_come = [&] {
    const std::scoped_lock lock(mutex_);
    return heard_ == std::vector<ChannelData>{{"shop", {0, 255}}};
  };
  while (!has_come() && steady_now_s() < until_s) {
    ASSERT_TRUE(visited->step(steady_now_s()));
    wait_a_moment();
  }
  EXPECT_TRUE(has_come());
}

}  // namespace
}  // namespace scree
