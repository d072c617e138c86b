// A whole server in-process, stepped by hand, with clients on loopback: what they hold is the server's field
// to the bit, also in a replay; every bad request gets an answer; ends and reports as it should.
#include "server/app/live_server.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "client/mirror/mirror.h"
#include "server/replay/verify.h"
#include "server/store/recording_reader.h"
#include "shared/base/limits.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/raw_client.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// A client that follows the server with a mirror.
class Follower {
 public:
  Follower(uint16_t port, glm::vec3 eye_m, float radius_m) : socket_(port) {
    EXPECT_TRUE(socket_.send(HelloMessage{protocol_version, "test", eye_m, radius_m}));
    welcome = socket_.receive_as<WelcomeMessage>();
    if (welcome) mirror.emplace(*welcome);
  }

  /// Applies messages up to the frame of `tick`, and what came with it; false when it does not come.
  bool follow_to(Tick tick) {
    while (mirror->tick() < tick) {
      const auto message = socket_.receive();
      if (!message || !apply(*message)) return false;
    }
    return true;
  }
  bool apply(const ServerMessage& message) {
    if (const auto* reply = std::get_if<ReplyMessage>(&message)) replies.push_back(*reply);
    if (const auto* refusal = std::get_if<RefusalMessage>(&message)) refused_because = refusal->reason;
    if (std::holds_alternative<RefusalMessage>(message)) return false;
    const auto applied = mirror->apply(message);
    EXPECT_TRUE(applied.has_value()) << applied.error().message;
    if (std::holds_alternative<FrameMessage>(message)) hashes[mirror->tick()] = mirror->field().hash();
    return applied.has_value();
  }
  RawClient& socket() { return socket_; }

  std::optional<WelcomeMessage> welcome;
  std::optional<Mirror> mirror;
  std::vector<ReplyMessage> replies;
  std::string refused_because;
  std::map<Tick, uint64_t> hashes;

 private:
  RawClient socket_;
};

CarveMessage carve_at(float x_m, float z_m, uint32_t request) {
  CarveMessage carve;
  carve.request = request;
  carve.shape = sphere({x_m, 0.0F, z_m}, 1.0F);
  carve.seeds = 6;
  carve.random_seed = request;
  carve.impact_m = {x_m, 1.0F, z_m};
  return carve;
}

class LiveServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("scree_live_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
    config.net.heartbeat_s = 0.0;
  }
  void TearDown() override {
    server.reset();
    fs::remove_all(folder);
  }
  void start() {
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
  }
  /// One tick, that every follower applies.
  void step(const std::vector<Follower*>& followers) {
    ASSERT_TRUE(server->step_once());
    for (Follower* follower : followers) ASSERT_TRUE(follower->follow_to(server->last_delta()->tick));
  }
  void settle(const std::vector<Follower*>& followers, int ticks_max = 3000) {
    int still = 0;
    for (int i = 0; i < ticks_max && still < 60; ++i) {
      step(followers);
      if (HasFatalFailure()) return;
      still = server->last_delta()->pieces.empty() ? still + 1 : 0;
    }
    EXPECT_EQ(still, 60) << "pieces are still alive";
  }
  void expect_held_equal(Follower& follower) {
    EXPECT_GT(follower.mirror->held_chunks().size(), 0U);
    for (const ChunkCoord chunk : follower.mirror->held_chunks())
      EXPECT_EQ(follower.mirror->field().chunk_hash(chunk), server->world()->field().chunk_hash(chunk));
    EXPECT_EQ(follower.mirror->mismatches(), 0U);
  }
  /// The answer to one request, after a tick or two.
  std::string answer_to(Follower& follower, const ClientMessage& message) {
    const size_t before = follower.replies.size();
    EXPECT_TRUE(follower.socket().send(message));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (follower.replies.size() == before && std::chrono::steady_clock::now() < deadline) {
      step({&follower});
      while (const auto more = follower.socket().receive(std::chrono::milliseconds(1))) follower.apply(*more);
    }
    return follower.replies.size() == before ? "no answer" : follower.replies.back().refusal;
  }

  fs::path folder;
  LiveConfig config;
  std::unique_ptr<LiveServer> server;
};

TEST_F(LiveServerTest, clients_that_join_late_see_little_or_reconnect_end_with_the_servers_field) {
  start();
  Follower first(server->port(), {0.0F, 2.0F, 0.0F}, 100.0F);
  Follower small(server->port(), {0.0F, 2.0F, 0.0F}, 12.0F);
  auto restless = std::make_unique<Follower>(server->port(), glm::vec3(0.0F, 2.0F, 0.0F), 100.0F);
  std::unique_ptr<Follower> late;
  for (uint32_t i = 0; i < 30; ++i) {
    const float x_m = 3.0F * static_cast<float>(i % 6) - 9.0F, z_m = 3.0F * static_cast<float>(i / 6) - 7.0F;
    ASSERT_TRUE(first.socket().send(carve_at(x_m, z_m, i + 1)));
    if (i == 10) restless.reset();
    if (i == 15) late = std::make_unique<Follower>(server->port(), glm::vec3(0.0F, 2.0F, 0.0F), 100.0F);
    if (i == 20) restless = std::make_unique<Follower>(server->port(), glm::vec3(0.0F, 2.0F, 0.0F), 100.0F);
    for (int tick = 0; tick < 4; ++tick) {
      std::vector<Follower*> followers{&first, &small};
      if (restless) followers.push_back(restless.get());
      if (late) followers.push_back(late.get());
      step(followers);
      if (HasFatalFailure()) return;
    }
  }
  settle({&first, &small, restless.get(), late.get()});
  for (Follower* follower : {&first, &small, restless.get(), late.get()}) expect_held_equal(*follower);
  EXPECT_EQ(first.mirror->field().hash(), server->world()->field().hash());
  EXPECT_EQ(late->mirror->field().hash(), server->world()->field().hash());
  EXPECT_EQ(first.replies.size(), 30U);
  const ServerReport report = server->report();
  EXPECT_EQ(report.net.published.repairs, 0U);
  EXPECT_EQ(report.net.published.resets, 0U);
  EXPECT_GE(report.operations.of<CarveOperation>(), 30U) << "blows and dents carve, too";
  EXPECT_EQ(report.ledger.error(), 0);
}

TEST_F(LiveServerTest, replay_gives_a_client_the_same_field_at_every_tick) {
  config.record_path = (folder / "session.scree").string();
  start();
  std::map<Tick, uint64_t> lived;
  {
    Follower follower(server->port(), {0.0F, 2.0F, 0.0F}, 100.0F);
    for (uint32_t i = 0; i < 300; ++i) {
      if (i % 60 == 0) {
        ASSERT_TRUE(follower.socket().send(carve_at(static_cast<float>(i / 20), 0.0F, i + 1)));
      }
      step({&follower});
      if (HasFatalFailure()) return;
    }
    lived = follower.hashes;
  }
  const auto stopped = server->stop();
  ASSERT_TRUE(stopped.has_value()) << stopped.error().message;
  EXPECT_EQ(server->report().ticks_recorded, 300U);
  config.replay.path = std::exchange(config.record_path, "");
  config.replay.at_end = AtEnd::end;
  start();
  Follower viewer(server->port(), {0.0F, 2.0F, 0.0F}, 100.0F);
  ASSERT_TRUE(viewer.welcome.has_value());
  EXPECT_TRUE(viewer.welcome->replay);
  for (int i = 0; i < 300; ++i) {
    step({&viewer});
    if (HasFatalFailure()) return;
  }
  EXPECT_FALSE(server->step_once());
  EXPECT_FALSE(server->running());
  EXPECT_EQ(viewer.hashes, lived);
  EXPECT_NE(lived.rbegin()->second, 0U);
}

TEST_F(LiveServerTest, every_bad_request_gets_an_answer_that_names_what_is_wrong) {
  start();
  Follower follower(server->port(), {0.0F, 2.0F, 0.0F}, 50.0F);
  CarveMessage huge = carve_at(0.0F, 0.0F, 1);
  huge.shape.radius_m = limits::edit_reach_max_m + 1.0F;
  EXPECT_NE(answer_to(follower, huge).find("may be at most 8 m"), std::string::npos)
      << follower.replies.back().refusal;
  CarveMessage negative = carve_at(0.0F, 0.0F, 2);
  negative.shape.radius_m = -1.0F;
  EXPECT_NE(answer_to(follower, negative).find("radius"), std::string::npos)
      << follower.replies.back().refusal;
  const std::string far = answer_to(follower, carve_at(1.0e6F, 0.0F, 3));
  EXPECT_NE(far.find("world"), std::string::npos) << far;
  CarveMessage crowded = carve_at(0.0F, 0.0F, 4);
  crowded.seeds = limits::seeds_max + 1;
  EXPECT_NE(answer_to(follower, crowded).find("seeds"), std::string::npos) << follower.replies.back().refusal;
  CarveMessage fast = carve_at(0.0F, 0.0F, 5);
  fast.blast_speed_m_s = limits::blast_speed_max_m_s + 1.0F;
  EXPECT_NE(answer_to(follower, fast).find("blast speed"), std::string::npos);
  EXPECT_EQ(answer_to(follower, carve_at(0.0F, 0.0F, 6)), "");
  EXPECT_EQ(server->report().operations.of<CarveOperation>(), 1U);
  const auto refusals = nlohmann::json::parse(to_json(server->report()))["refusals"];
  EXPECT_EQ(refusals,
            nlohmann::json::parse(R"({"total": 5, "by_reason": {"carve_invalid": 4, "blast_speed": 1}})"));
}

TEST_F(LiveServerTest, a_radius_that_is_no_number_is_refused_and_others_notice_nothing) {
  start();
  Follower witness(server->port(), {0.0F, 2.0F, 0.0F}, 50.0F);
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    Follower client(server->port(), {0.0F, 2.0F, 0.0F}, 50.0F);
    CarveMessage carve = carve_at(0.0F, 0.0F, 1);
    carve.shape.radius_m = bad;
    ASSERT_TRUE(client.socket().send(carve));
    const auto refusal = client.socket().receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_NE(refusal->reason.find("radius"), std::string::npos) << refusal->reason;
    EXPECT_TRUE(client.socket().closed_within(std::chrono::seconds(10)));
  }
  EXPECT_EQ(answer_to(witness, carve_at(0.0F, 0.0F, 1)), "");
}

TEST_F(LiveServerTest, port_in_use_leaves_no_recording_behind) {
  start();
  LiveConfig second = config;
  second.net.port = server->port();
  second.record_path = (folder / "second.scree").string();
  const auto started = LiveServer::start(second);
  ASSERT_FALSE(started.has_value());
  EXPECT_NE(started.error().message.find("in use"), std::string::npos) << started.error().message;
  EXPECT_FALSE(fs::exists(second.record_path));
}

TEST_F(LiveServerTest, a_world_beyond_its_limits_is_refused_and_leaves_no_recording) {
  config.world.terrain.voxel_size_m = 0.05F;
  config.record_path = (folder / "none.scree").string();
  const auto started = LiveServer::start(config);
  ASSERT_FALSE(started.has_value());
  EXPECT_NE(started.error().message.find("voxel_size_min_m"), std::string::npos) << started.error().message;
  EXPECT_FALSE(fs::exists(config.record_path));
}

TEST_F(LiveServerTest, foreign_recording_is_refused_by_name) {
  config.replay.path = (folder / "letter.txt").string();
  std::ofstream(config.replay.path) << "This is a letter and not a recording of anything at all.";
  const auto started = LiveServer::start(config);
  ASSERT_FALSE(started.has_value());
  EXPECT_NE(started.error().message.find("letter.txt is no recording"), std::string::npos)
      << started.error().message;
}

TEST_F(LiveServerTest, a_kept_world_that_is_recorded_may_stop_before_its_next_tick_and_goes_on_later) {
  config.world_path = (folder / "world").string();
  config.record_path = (folder / "session.scree").string();
  start();
  for (int tick = 1; tick <= 3; ++tick) ASSERT_TRUE(server->step_once());
  ASSERT_TRUE(server->stop().has_value());
  const SettingValues settings = server->report().settings;
  EXPECT_FALSE(settings.empty());
  for (int round = 0; round < 2; ++round) {
    server.reset();
    start();
    EXPECT_EQ(server->report().settings, settings);
    const auto stopped = server->stop();
    ASSERT_TRUE(stopped.has_value()) << stopped.error().message;
  }
  server.reset();
  start();
  ASSERT_TRUE(server->step_once());
  EXPECT_EQ(server->last_delta()->tick, 4U);
  ASSERT_TRUE(server->stop().has_value());
  auto reader = RecordingReader::open(config.record_path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 4U);
}

TEST_F(LiveServerTest, a_recording_that_is_a_ring_drops_what_is_older_and_verifies) {
  config.record_path = (folder / "session.scree").string();
  config.record_ring = {.seconds = 2.0};
  start();
  {
    Follower follower(server->port(), {0.0F, 2.0F, 0.0F}, 50.0F);
    for (uint32_t i = 0; i < 400; ++i) {  // pieces fall while parts begin
      if (i % 40 == 0) {
        ASSERT_TRUE(follower.socket().send(carve_at(static_cast<float>(i / 20), 0.0F, i + 1)));
      }
      step({&follower});
      if (HasFatalFailure()) return;
    }
  }
  // The recorder lags by limits::recorder_queue_max ticks at most.
  for (int i = 0; i < 1200; ++i) ASSERT_TRUE(server->step_once());
  ASSERT_TRUE(server->stop().has_value());
  auto reader = RecordingReader::open(config.record_path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 1600U);
  EXPECT_GT((*reader)->first_tick(), 1U);
  EXPECT_LE((*reader)->first_tick(), 1480U);
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
}

TEST_F(LiveServerTest, real_time_ends_after_its_ticks_and_reports) {
  config.pacing = Pacing::real_time;
  config.ticks_max = 20;
  config.record_path = (folder / "session.scree").string();
  start();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (server->running() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  ASSERT_TRUE(server->stop().has_value());
  const auto json = nlohmann::json::parse(to_json(server->report()));
  EXPECT_EQ(json["ticks"], 20);
  EXPECT_EQ(json["ledger"]["error"], 0);
  EXPECT_EQ(json["stages_ms"]["tick"]["count"], 20);
  EXPECT_EQ(json["recording"]["ticks"], 20);
  auto reader = RecordingReader::open(config.record_path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 20U);
}

}  // namespace
}  // namespace scree
