// A replay in the viewer: wishes that go to the server one at a time, three sessions of which one drags
// wildly, and looking through another person's eye.
#include "client/viewer/session/timeline.h"

#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

#include "client/cache/join_server.h"
#include "client/viewer/session/followed_eye.h"
#include "client/viewer/session/viewer_session.h"
#include "server/app/live_server.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "tests/support/patience.h"
#include "tests/support/recorded_session.h"

namespace scree {
namespace {

PlaybackMessage at_moment(Tick moment, uint64_t heeded = 0) {
  return {moment, 0, 6000, 1.0F, true, heeded};
}

Timeline known_timeline(const PlaybackMessage& playback = at_moment(600)) {
  Timeline timeline;
  timeline.begin(60.0);
  timeline.apply(playback, 10.0);
  return timeline;
}

TEST(Timeline, of_seeks_that_wait_the_last_counts_and_one_is_under_way) {
  Timeline timeline = known_timeline();
  for (const double tick : {100.0, 200.0, 300.0}) timeline.seek(tick);
  const auto first = timeline.pop_due(10.0);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->value, 300);
  for (const double tick : {400.0, 99999.0}) timeline.seek(tick);
  EXPECT_FALSE(timeline.pop_due(10.1)) << "one is under way";
  EXPECT_EQ(timeline.moment(10.1), 6000.0) << "what is wanted is shown";
  timeline.apply(at_moment(300, 1), 10.2);
  const auto second = timeline.pop_due(10.2);
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->value, 6000) << "within the recording";
  EXPECT_FALSE(timeline.pop_due(10.2));
}

TEST(Timeline, tells_a_jump_from_playing) {
  Timeline timeline;
  timeline.begin(60.0);
  EXPECT_FALSE(timeline.apply(at_moment(600), 10.0)) << "the first word";
  EXPECT_FALSE(timeline.apply(at_moment(660), 11.0));
  EXPECT_FALSE(timeline.apply(at_moment(730), 12.0)) << "a little off";
  EXPECT_TRUE(timeline.apply(at_moment(300), 12.1));
  EXPECT_FALSE(timeline.apply(at_moment(306), 12.2));
}

TEST(Timeline, goes_on_when_a_move_is_refused_or_gets_lost) {
  Timeline timeline = known_timeline();
  timeline.seek(100.0);
  ASSERT_TRUE(timeline.pop_due(10.0));
  timeline.seek(200.0);
  EXPECT_FALSE(timeline.pop_due(10.1));
  timeline.refused();
  EXPECT_TRUE(timeline.pop_due(10.1));
  timeline.seek(300.0);
  EXPECT_FALSE(timeline.pop_due(10.2));
  EXPECT_TRUE(timeline.pop_due(20.0));
}

TEST(Timeline, keys_are_wishes_in_their_order) {
  Timeline timeline = known_timeline();
  const auto due = [&](Action action) {
    timeline.act(action);
    return timeline.pop_due(10.0).value_or(ControlReplayRequest{.value = -77});
  };
  EXPECT_EQ(due(Action::replay_play), (ControlReplayRequest{.play = ReplayPlay::pause}));
  EXPECT_EQ(due(Action::replay_play), (ControlReplayRequest{.play = ReplayPlay::play}));
  EXPECT_EQ(due(Action::replay_faster), (ControlReplayRequest{.speed = 2.0F}));
  EXPECT_EQ(due(Action::replay_faster), (ControlReplayRequest{.speed = 4.0F}));
  EXPECT_EQ(due(Action::replay_turn), (ControlReplayRequest{.play = ReplayPlay::play, .speed = -4.0F}));
  EXPECT_EQ(due(Action::replay_slower), (ControlReplayRequest{.speed = -2.0F}));
  EXPECT_EQ(due(Action::replay_next_event), (ControlReplayRequest{.move = ReplayMove::next_event}));
  EXPECT_EQ(due(Action::walk).value, -77) << "another room's";
  timeline.act(Action::replay_second_back);
  timeline.act(Action::replay_tick_on);
  timeline.apply(at_moment(700, 7), 10.5);
  EXPECT_EQ(timeline.pop_due(10.5), (ControlReplayRequest{.move = ReplayMove::by_ticks, .value = -60}));
}

TEST(Timeline, who_may_not_control_asks_for_nothing_and_sees_the_moment_go_on) {
  PlaybackMessage playback = at_moment(600);
  playback.refusal = "ask for a token";
  Timeline timeline = known_timeline(playback);
  timeline.seek(100.0);
  timeline.act(Action::replay_play);
  EXPECT_FALSE(timeline.pop_due(10.0));
  EXPECT_NEAR(timeline.moment(11.0), 660.0, 0.01);
  EXPECT_EQ(timeline.moment(1000.0), 6000.0);
  EXPECT_EQ(time_text(660.0, 60.0), "0:11");
  EXPECT_EQ(time_text(3723.0 * 60.0, 60.0), "1:02:03");
}

Figures figures_of(const std::vector<PlayerCursor>& cursors, double now_s) {
  Figures figures;
  figures.step(cursors, now_s);
  return figures;
}

TEST(FollowedEye, goes_round_those_who_are_there_and_moves_the_camera_smoothly) {
  std::vector<PlayerCursor> cursors{{3, "Ann", {0.0F, 2.0F, 0.0F}, {10.0F, 2.0F, 0.0F}},
                                    {recorded_person(1), "Bo", {5.0F, 2.0F, 0.0F}, {5.0F, 2.0F, -9.0F}}};
  Figures figures = figures_of(cursors, 10.0);
  FollowedEye eye;
  Camera camera;
  camera.eye_m = {50.0F, 0.0F, 50.0F};
  eye.next(figures);
  EXPECT_EQ(eye.person(), 3U);
  eye.step(camera, figures, 10.0);
  EXPECT_EQ(camera.eye_m, cursors[0].eye_m) << "at once, from far";
  EXPECT_NEAR(camera.forward().x, 1.0F, 1e-3F);
  cursors[0].eye_m.x = 1.0F;
  figures = figures_of(cursors, 10.02);
  eye.step(camera, figures, 10.02);
  EXPECT_GT(camera.eye_m.x, 0.0F);
  EXPECT_LT(camera.eye_m.x, 0.5F);
  for (int i = 0; i < 100; ++i) eye.step(camera, figures, 10.02 + 0.02 * i);
  EXPECT_NEAR(camera.eye_m.x, 1.0F, 0.01F);
  eye.step(camera, figures_of({cursors[1]}, 13.0), 13.0);
  EXPECT_NEAR(camera.eye_m.x, 1.0F, 0.01F) << "who is gone leaves the camera where it was";
  EXPECT_NE(eye.description(figures_of({cursors[1]}, 13.0)).find("Ann, who is not there"), std::string::npos);
  eye.next(figures);
  EXPECT_EQ(eye.person(), recorded_person(1));
  eye.next(figures);
  EXPECT_FALSE(eye.follows()) << "one's own";
}

TEST(FollowedEye, turns_even_to_where_it_came_from) {
  Figures figures = figures_of({{3, "", {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -9.0F}}}, 10.0);
  FollowedEye eye;
  Camera camera;
  eye.next(figures);
  eye.step(camera, figures, 10.0);
  figures = figures_of({{3, "", {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 9.0F}}}, 10.0);
  for (int i = 0; i < 200; ++i) eye.step(camera, figures, 10.0 + 0.02 * i);
  EXPECT_NEAR(camera.forward().z, 1.0F, 0.01F);
}

/// Sessions of viewers, without windows, that look at one replay. The server ticks with their steps.
class ReplayedSessions : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("scree_replayed_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "session.scree").string();
    record_session(path_, 420);
    LiveConfig config;
    config.pacing = Pacing::by_hand;
    config.replay.path = path_;
    config.net.port = 0;
    config.net.admin_token = admin_token_;
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }
  void TearDown() override {
    sessions_.clear();
    server_.reset();
    std::filesystem::remove_all(folder_);
  }
  void join(const std::string& token) {
    ServerEndpoint endpoint;
    endpoint.host = "127.0.0.1";
    endpoint.port = server_->port();
    endpoint.token = token;
    sessions_.push_back(std::make_unique<ViewerSession>(std::make_unique<ServerConnector>(endpoint),
                                                        SessionChoice{.interest_radius_m = 60.0F}));
  }
  void frame() {
    server_->step_once();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (const auto& session : sessions_) session->step(steady_now_s(), camera_);
  }
  template <typename Condition>
  void until(const char* what, const Condition& condition) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << what << " does not come";
      frame();
    }
  }
  bool all(const std::function<bool(ViewerSession&)>& condition) {
    return std::ranges::all_of(sessions_, [&](const auto& session) { return condition(*session); });
  }

  const std::string admin_token_ = "a-token-of-some-length";
  std::filesystem::path folder_;
  std::string path_;
  std::unique_ptr<LiveServer> server_;
  std::vector<std::unique_ptr<ViewerSession>> sessions_;
  Camera camera_{{0.0F, 2.0F, 0.0F}};
};

TEST_F(ReplayedSessions, three_see_the_same_whatever_one_drags) {
  for (const char* token : {"", "a-token-of-some-length", ""}) join(token);
  until("where the replay stands", [&] { return all([](auto& s) { return s.timeline().is_known(); }); });
  EXPECT_FALSE(sessions_[0]->timeline().may_control());
  EXPECT_NE(sessions_[0]->timeline().playback().refusal.find("token"), std::string::npos);
  Timeline& hand = sessions_[1]->timeline();
  EXPECT_TRUE(hand.may_control());
  hand.ask({.play = ReplayPlay::pause});
  Random random(17);
  constexpr int drags = 250;
  for (int i = 0; i < drags; ++i) {
    hand.seek(static_cast<double>(random.below(421)));
    frame();
  }
  hand.seek(333.0);
  const auto playback = [&] { return server_->last_delta()->playback.value(); };
  const auto is_there = [&](ViewerSession& session) {
    return session.timeline().playback().moment == 333 && session.joined(steady_now_s()) &&
           session.mirror()->field().hash() == server_->last_delta()->field_hash;
  };
  until("the moment for all", [&] { return playback().moment == 333 && all(is_there); });
  EXPECT_LT(playback().heeded, static_cast<uint64_t>(drags)) << "dragging asks for no more than is shown";
  EXPECT_GT(playback().heeded, 5U);
  for (const auto& session : sessions_) {
    EXPECT_EQ(session->mirror()->counters().resets, 0U);
    EXPECT_EQ(session->mirror()->mismatches(), 0U);
    EXPECT_LT(session->waiting_bytes(), size_t{1} << 20U);
  }
  EXPECT_EQ(server_->report().net.sessions_disconnected, 0U);
}

TEST_F(ReplayedSessions, know_the_events_and_who_was_there) {
  join("");
  ViewerSession& session = *sessions_[0];
  const auto marks_of = [&](EventKind kind) {
    return std::ranges::count(session.timeline().marks().marks, kind, &Mark::kind);
  };
  until("the events", [&] { return marks_of(EventKind::carve) >= 4; });
  EXPECT_EQ(session.timeline().marks().read_to, 420U);
  until("who was there", [&] { return session.figures(steady_now_s()).all().contains(recorded_person(3)); });
  EXPECT_EQ(session.figures(steady_now_s()).all().at(recorded_person(3)).name, "Ann");
}

}  // namespace
}  // namespace scree
