// A replay's server, controlled by its viewers: all see the same moment, whatever one of them asks for; their
// mirrors get the recorded state without being reset; and nobody controls it who may not.
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

#include "client/admin/admin.h"
#include "client/mirror/mirror.h"
#include "server/app/live_server.h"
#include "server/replay/recorded_cursors.h"
#include "shared/base/random.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/raw_client.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

/// Looks at a replay with a mirror.
class ReplayViewer {
 public:
  explicit ReplayViewer(uint16_t port) : socket_(port) {
    EXPECT_TRUE(socket_.send(HelloMessage{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 100.0F}));
    if (const auto welcome = socket_.receive_as<WelcomeMessage>()) mirror.emplace(*welcome);
  }
  bool follow_to(Tick tick) {
    while (mirror && mirror->tick() < tick)
      if (!receive()) return false;
    return mirror.has_value();
  }
  bool receive() {
    const auto message = socket_.receive();
    if (!message) return false;
    if (const auto* playback = std::get_if<PlaybackMessage>(&*message)) playbacks.push_back(*playback);
    if (const auto* reply = std::get_if<ReplyMessage>(&*message)) replies.push_back(*reply);
    if (const auto* told = std::get_if<CursorsMessage>(&*message)) cursors = told->cursors;
    const auto applied = mirror->apply(*message);
    EXPECT_TRUE(applied.has_value()) << applied.error().message;
    return applied.has_value();
  }
  void ask(const ControlReplayRequest& wish, const std::string& token = "") {
    EXPECT_TRUE(socket_.send(AdminMessage{1, token, wish}));
  }

  void set_eye(glm::vec3 eye_m) { EXPECT_TRUE(socket_.send(CursorMessage{eye_m, {}})); }

  std::optional<Mirror> mirror;
  std::vector<PlayerCursor> cursors;
  std::vector<PlaybackMessage> playbacks;
  std::vector<ReplyMessage> replies;

 private:
  RawClient socket_;
};

class ReplayControlTest : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    config.pacing = Pacing::by_hand;
  }
  void TearDown() override {
    viewers.clear();
    server.reset();
    RecordingTest::TearDown();
  }
  void start(Tick ticks, size_t viewers_count) {
    simulate(ticks);
    record();
    config.replay.path = path;
    config.net.heartbeat_s = 0.0;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
    for (size_t i = 0; i < viewers_count; ++i)
      viewers.push_back(std::make_unique<ReplayViewer>(server->port()));
  }
  void step() {
    ASSERT_TRUE(server->step_once());
    for (const auto& viewer : viewers) ASSERT_TRUE(viewer->follow_to(server->last_delta()->tick));
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      step();
      if (HasFatalFailure()) return;
    }
  }
  PlaybackMessage playback() const { return server->last_delta()->playback.value(); }
  /// Steps until the wish is carried out.
  void carry_out(ReplayViewer& viewer, const ControlReplayRequest& wish) {
    const uint64_t before = playback().heeded;
    viewer.ask(wish);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (playback().heeded == before) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      step();
      if (HasFatalFailure()) return;
    }
  }
  /// Once what is streamed has come.
  void expect_all_see_the_moment() {
    steps(12);
    const Tick moment = playback().moment;
    for (const auto& viewer : viewers) {
      const Mirror& mirror = *viewer->mirror;
      EXPECT_EQ(viewer->mirror->field().hash(), moment == 0 ? 0 : deltas[moment - 1]->field_hash) << moment;
      EXPECT_EQ(mirror.pieces().size(), moment == 0 ? 0 : deltas[moment - 1]->pieces.size()) << moment;
      EXPECT_EQ(mirror.counters().resets, 0U);
      EXPECT_EQ(mirror.mismatches(), 0U);
      EXPECT_EQ(viewer->playbacks.back().heeded, playback().heeded);
    }
  }

  LiveConfig config;
  std::unique_ptr<LiveServer> server;
  std::vector<std::unique_ptr<ReplayViewer>> viewers;
};

TEST_F(ReplayControlTest, three_viewers_see_the_moments_that_one_drags_through) {
  start(320, 3);
  steps(30);
  expect_all_see_the_moment();
  carry_out(*viewers[0], {.play = ReplayPlay::pause});
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    const int64_t to = i == 10 ? 0 : random.below(320);
    carry_out(*viewers[random.below(3)], {.move = ReplayMove::to_tick, .value = to});
    EXPECT_EQ(playback().moment, static_cast<Tick>(to));
    if (i % 3 != 0) continue;  // else the next comes before this one is all told
    expect_all_see_the_moment();
    if (HasFailure()) return;
  }
  carry_out(*viewers[1], {.play = ReplayPlay::play, .speed = -1.0F});
  steps(40);
  carry_out(*viewers[2], {.play = ReplayPlay::play, .speed = 4.0F});
  steps(40);
  carry_out(*viewers[2], {.play = ReplayPlay::pause});
  expect_all_see_the_moment();
  EXPECT_EQ(server->report().net.sessions_disconnected, 0U);
}

TEST_F(ReplayControlTest, a_carve_that_is_played_again_makes_its_pieces_again) {
  start(60, 2);
  steps(40);
  for (int i = 0; i < 3; ++i) {
    carry_out(*viewers[0], {.play = ReplayPlay::play, .move = ReplayMove::to_tick, .value = 8});
    EXPECT_TRUE(viewers[0]->mirror->pieces().empty());
    steps(20);
    EXPECT_GT(viewers[0]->mirror->pieces().size(), 0U);
  }
  EXPECT_GT(viewers[0]->mirror->counters().operations.of<CarveOperation>(), 1U);
  carry_out(*viewers[0], {.play = ReplayPlay::pause});
  expect_all_see_the_moment();
}

TEST_F(ReplayControlTest, who_is_no_administrator_is_refused_where_there_can_be_one) {
  config.net.admin_token = "a-token-of-some-length";
  start(60, 1);
  step();
  viewers[0]->ask({.play = ReplayPlay::pause});
  while (viewers[0]->replies.empty()) ASSERT_TRUE(viewers[0]->receive());
  EXPECT_EQ(viewers[0]->replies[0].refusal_name, "role");
  steps(3);
  EXPECT_TRUE(playback().playing);
  viewers[0]->ask({.play = ReplayPlay::pause}, config.net.admin_token);
  while (viewers[0]->replies.size() < 2) ASSERT_TRUE(viewers[0]->receive());
  EXPECT_EQ(viewers[0]->replies[1].refusal, "");
  steps(1);
  EXPECT_FALSE(playback().playing);
}

TEST_F(ReplayControlTest, the_program_waits_until_it_is_so) {
  config.pacing = Pacing::real_time;
  start(200, 0);
  AdminServer at;
  at.port = server->port();
  auto now = control_replay(at, {.play = ReplayPlay::pause, .move = ReplayMove::to_tick, .value = 150});
  ASSERT_TRUE(now.has_value()) << now.error().message;
  EXPECT_EQ(now->moment, 150U);
  EXPECT_FALSE(now->playing);
  now = control_replay(at, {.move = ReplayMove::by_ticks, .value = -60});
  ASSERT_TRUE(now.has_value()) << now.error().message;
  EXPECT_EQ(now->moment, 90U);
  EXPECT_EQ(now->last, 200U);
  EXPECT_TRUE(holds(playback_lines(*now), "moment 90 of 0 to 200, paused")) << playback_lines(*now);
}

TEST_F(ReplayControlTest, a_live_server_has_nothing_to_control) {
  config.pacing = Pacing::real_time;
  auto started = LiveServer::start(config);
  ASSERT_TRUE(started.has_value()) << started.error().message;
  AdminServer at;
  at.port = (*started)->port();
  const auto refused = control_replay(at, {.play = ReplayPlay::pause});
  ASSERT_FALSE(refused.has_value());
  EXPECT_TRUE(holds(refused.error().message, "--replay")) << refused.error().message;
}

TEST(ReplayControl, a_tick_that_is_not_there_is_told) {
  const PlaybackMessage at{.moment = 400, .first = 400, .last = 900};
  const auto told = [&](ReplayMove move, int64_t value) {
    return went_elsewhere({.move = move, .value = value}, at);
  };
  EXPECT_EQ(told(ReplayMove::to_tick, 400), "");
  EXPECT_EQ(told(ReplayMove::to_tick, 900), "");
  EXPECT_EQ(told(ReplayMove::by_ticks, 5), "");
  EXPECT_TRUE(
      holds(told(ReplayMove::to_tick, 5), "tick 5 is not in the recording, which has the ticks 400 to 900"));
  EXPECT_TRUE(holds(told(ReplayMove::to_tick, 901), "tick 901"));
}

TEST_F(ReplayControlTest, a_live_server_logs_its_events_and_records_them) {
  config.record_path = path;
  config.events_path = (folder / "events.jsonl").string();
  config.net.heartbeat_s = 0.0;
  auto started = LiveServer::start(config);
  ASSERT_TRUE(started.has_value()) << started.error().message;
  server = std::move(*started);
  {
    ReplayViewer viewer(server->port()), other(server->port());
    viewer.set_eye({1.0F, 2.0F, 3.0F});
    while (other.cursors.empty()) {
      ASSERT_TRUE(server->step_once());
      ASSERT_TRUE(other.follow_to(server->last_delta()->tick));
    }
    for (int i = 0; i < 12; ++i) ASSERT_TRUE(server->step_once());
  }
  ASSERT_TRUE(server->stop().has_value());
  EXPECT_GE(server->report().events.written, 1U);
  EXPECT_EQ(server->report().events.health.lost, 0U);
  const auto bytes = read_file(config.events_path);
  EXPECT_TRUE(holds({bytes.data(), bytes.size()}, R"({"event":"join","tick":)")) << bytes.data();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  const auto rows = (*reader)->machine(1, (*reader)->last_tick());
  ASSERT_TRUE(rows.has_value());
  size_t joins = 0;
  for (const RecordedMachine& row : *rows)
    joins += std::ranges::count(row.events, EventKind::join, &Event::kind);
  EXPECT_EQ(joins, 2U);
  RecordedCursors recorded;
  const auto there = recorded.at(**reader, (*reader)->last_tick());
  ASSERT_TRUE(there.has_value()) << there.error().message;
  ASSERT_EQ(there->size(), 1U) << "who says nothing of an eye has none";
  EXPECT_EQ(there->front().eye_m, glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST_F(ReplayControlTest, a_live_server_is_looked_back_at_while_it_goes_on) {
  config.record_path = path;
  auto started = LiveServer::start(config);
  ASSERT_TRUE(started.has_value()) << started.error().message;
  const std::unique_ptr<LiveServer> live = std::move(*started);
  LiveConfig replaying;
  replaying.pacing = Pacing::by_hand;
  replaying.replay.path = path;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  const auto live_step = [&] {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    ASSERT_TRUE(live->step_once());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  // It has no tick yet.
  started = LiveServer::start(replaying);
  ASSERT_TRUE(started.has_value()) << started.error().message;
  server = std::move(*started);
  step();
  EXPECT_EQ(playback().last, 0U);
  const Tick begun = playback().last;
  EXPECT_TRUE(playback().grows);
  while (playback().last < begun + 30) {
    live_step();
    step();
  }
  ASSERT_TRUE(live->stop().has_value()) << "although somebody reads its recording";
  while (playback().grows) step();
  EXPECT_EQ(playback().last, live->last_delta()->tick);
}

}  // namespace
}  // namespace scree
