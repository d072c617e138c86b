// A viewer's session that shows its own carves before the server answers, against a whole server that ticks
// only when the test says so.
#include <gtest/gtest.h>
#include <thread>

#include "client/cache/join_server.h"
#include "client/session/limits.h"
#include "client/viewer/session/viewer_session.h"
#include "server/app/live_server.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

class PredictingViewer : public testing::Test {
 protected:
  using Session = scree::ViewerSession;

  /// A server, and a session that has joined it.
  void start(const std::function<void(LiveConfig&)>& change = {}) {
    LiveConfig config;
    config.pacing = Pacing::by_hand;
    config.world.terrain.kind = TerrainKind::flat;
    if (change) change(config);
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    ServerEndpoint endpoint;
    endpoint.host = "127.0.0.1";
    endpoint.port = server_->port();
    session_ = std::make_unique<Session>(std::make_unique<ServerConnector>(endpoint), choice_);
    camera_.eye_m = {0.0F, 3.0F, 0.0F};
    until("the world", true, [&] { return session_->joined(steady_now_s()); });
  }
  SessionChoice choice_{.interest_radius_m = 24.0F};
  SessionStep step() { return session_->step(steady_now_s(), camera_); }
  /// Steps the session, and the server if it `ticks`.
  template <typename Condition>
  void until(const char* what, bool ticks, const Condition& condition) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << what << " does not come";
      if (ticks && server_) server_->step_once();
      step();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  void strike() {
    Tool carves;
    take_up(carves, ToolUse::carve);
    session_->strike(carves, camera_.eye_m, glm::vec3(0.0F, -1.0F, 0.0F), steady_now_s());
  }
  /// Depth of what is shown, and of what the server has told, under the camera; metres from it.
  float shown_m() { return session_->aim(camera_.eye_m, {0.0F, -1.0F, 0.0F}).value_or(glm::vec3(-99.0F)).y; }
  uint64_t exact_hash() { return session_->mirror()->field().hash(); }

  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<Session> session_;
  Camera camera_;
};

TEST_F(PredictingViewer, a_strike_is_in_the_next_frame_and_then_as_the_server_says) {
  start();
  if (HasFatalFailure()) return;
  EXPECT_FALSE(session_->latency());
  strike();
  EXPECT_EQ(session_->predictions(), 1U);
  const SessionStep next = step();
  EXPECT_FALSE(next.changes.bricks.empty());
  EXPECT_GT(next.changes.pieces_added.size(), 1U);
  EXPECT_EQ(session_->pieces(steady_now_s()).size(), next.changes.pieces_added.size());
  EXPECT_LT(shown_m(), -0.5F) << "the next strike aims into the hole";
  EXPECT_EQ(exact_hash(), 0U);

  until("the answer", true, [&] { return session_->latency().has_value(); });
  until("the server's carve", true, [&] { return session_->predictions() == 0; });
  EXPECT_NE(exact_hash(), 0U);
  EXPECT_EQ(&session_->field(), &session_->mirror()->field());
  EXPECT_EQ(session_->pieces(steady_now_s()).size(), session_->mirror()->pieces().size());
  EXPECT_LE(session_->latency()->server.total_ms(), session_->latency()->total_ms + 1.0);
}

TEST_F(PredictingViewer, a_session_with_little_time_for_messages_takes_one_a_step_and_comes_to_the_same) {
  choice_.apply_s = 1e-9;
  start();
  if (HasFatalFailure()) return;
  strike();
  until("the server's carve", true,
        [&] { return session_->latency().has_value() && session_->predictions() == 0; });
  until("what is due", false, [&] { return exact_hash() != 0; });
  EXPECT_EQ(session_->mirror()->mismatches(), 0U);
  EXPECT_GT(session_->apply_worst_ms(), 0.0);
}

TEST_F(PredictingViewer, what_the_server_refuses_is_taken_back) {
  start([](LiveConfig& config) { config.world.pieces_max = 1; });
  if (HasFatalFailure()) return;
  strike();
  step();
  EXPECT_LT(shown_m(), -0.5F);
  until("the refusal", true, [&] { return session_->predictions() == 0; });
  EXPECT_NEAR(shown_m(), 0.0F, 0.05F);
  EXPECT_EQ(exact_hash(), 0U);
  EXPECT_EQ(session_->answer().refused, "too much rubble");
  const std::string said = session_->notice(steady_now_s());
  EXPECT_NE(said.find("pieces"), std::string::npos) << said;
  EXPECT_EQ(said.find("pieces-max"), std::string::npos) << "names of settings are an operator's";
}

TEST_F(PredictingViewer, beyond_the_servers_reach_nothing_is_asked_for_and_that_is_said) {
  start([](LiveConfig& config) { config.world.service.reach_m = 10.0; });
  if (HasFatalFailure()) return;
  until("a status", true, [&] { return session_->mirror()->status().has_value(); });
  const Shape below = sphere({0.0F, 0.0F, 0.0F}, 1.0F);
  EXPECT_TRUE(session_->is_beyond_reach(below, {0.0F, 11.5F, 0.0F}));
  EXPECT_FALSE(session_->is_beyond_reach(below, {0.0F, 10.5F, 0.0F})) << "to its nearest point";
  camera_.eye_m.y = 20.0F;
  strike();
  EXPECT_EQ(session_->predictions(), 0U);
  const std::string said = session_->notice(steady_now_s());
  EXPECT_NE(said.find("you reach 10 m"), std::string::npos) << said;
  EXPECT_EQ(session_->answer().refused, "too far away");
  camera_.eye_m.y = 5.0F;
  strike();
  EXPECT_EQ(session_->predictions(), 1U);
}

TEST_F(PredictingViewer, a_lost_server_takes_it_back_and_another_world_knows_nothing_of_it) {
  start();
  if (HasFatalFailure()) return;
  strike();
  step();
  EXPECT_EQ(session_->predictions(), 1U);
  const uint16_t port = server_->port();
  server_.reset();
  until("the loss", false, [&] { return !session_->connected(); });
  EXPECT_EQ(session_->predictions(), 0U);
  EXPECT_NEAR(shown_m(), 0.0F, 0.05F);
  strike();
  EXPECT_EQ(session_->predictions(), 0U);
  EXPECT_LE(session_->next_try_s(steady_now_s()).value_or(0.0), limits::reconnect_min_s);
  LiveConfig config;
  config.pacing = Pacing::by_hand;
  config.world.terrain.kind = TerrainKind::flat;
  config.net.port = port;
  auto again = LiveServer::start(config);
  ASSERT_TRUE(again) << again.error().message;
  server_ = std::move(*again);
  session_->try_now();
  until("the new world", true, [&] { return session_->joined(steady_now_s()); });
  EXPECT_NE(session_->notice(steady_now_s()).find("another world"), std::string::npos);
  strike();
  EXPECT_EQ(session_->predictions(), 1U);
}

TEST_F(PredictingViewer, switched_off_it_waits_for_the_server) {
  start();
  if (HasFatalFailure()) return;
  strike();
  session_->predict(false);
  step();
  EXPECT_EQ(session_->predictions(), 0U) << "what was shown is taken back";
  EXPECT_NEAR(shown_m(), 0.0F, 0.05F);
  strike();
  EXPECT_EQ(session_->predictions(), 0U);
  until("the server's carve", true, [&] { return exact_hash() != 0; });
}

TEST_F(PredictingViewer, who_may_not_carve_predicts_nothing) {
  start([](LiveConfig& config) { config.net.access.anonymous = Role::viewer; });
  if (HasFatalFailure()) return;
  strike();
  EXPECT_EQ(session_->predictions(), 0U);
}

TEST_F(PredictingViewer, ground_that_may_not_have_arrived_is_not_predicted) {
  start();
  if (HasFatalFailure()) return;
  camera_.eye_m = {300.0F, 3.0F, 0.0F};  // not reported yet: the server sends nothing from there
  strike();
  EXPECT_EQ(session_->predictions(), 0U);
}

}  // namespace
}  // namespace scree
