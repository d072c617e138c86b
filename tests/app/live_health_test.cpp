// A live server's health: a simulation that stands still, a world that cannot be saved, and what a program
// that asks gets to hear.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

#include "client/admin/admin.h"
#include "server/app/heartbeat.h"
#include "server/app/live_server.h"
#include "server/app/save_delay.h"
#include "tests/store/passing_fault.h"
#include "tests/support/captured_log.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/raw_client.h"
#include "tests/support/test_folder.h"
#include "tests/support/web_client.h"

namespace scree {
namespace {

class LiveHealthTest : public ::testing::Test {
 protected:
  void start(const std::function<void(LiveConfig&)>& change = {}) {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.sim_threads = 1;
    if (change) change(config);
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
  }
  int status(const std::string& path) const { return HttpClient(server->port()).get(path).status; }
  std::string body(const std::string& path) const { return HttpClient(server->port()).get(path).body; }
  /// Waits for this answer.
  bool comes_to(const std::string& path, int wanted) const {
    for (const Within within(60.0); status(path) != wanted; wait_a_moment())
      if (within.over()) return false;
    return true;
  }
  Result<HealthMessage> ask() const {
    AdminServer target;
    target.port = server->port();
    return read_health(target);
  }

  TestFolder folder;
  std::unique_ptr<LiveServer> server;
};

TEST_F(LiveHealthTest, a_simulation_that_stands_still_is_said_on_every_way) {
  std::mutex gate;
  std::unique_lock still(gate, std::defer_lock);
  start([&](LiveConfig& config) {
    config.still_seconds = 0.3;
    config.hooks.before = [&](const World&, TickCommands&) { const std::scoped_lock pass(gate); };
  });
  EXPECT_TRUE(comes_to("/healthz", 200));
  ASSERT_TRUE(ask() && ask()->alive);
  still.lock();
  EXPECT_TRUE(comes_to("/livez", 503));
  EXPECT_EQ(status("/healthz"), 503);
  EXPECT_EQ(status("/readyz"), 503);
  EXPECT_TRUE(holds(body("/healthz"), "no tick has ended for")) << body("/healthz");
  const auto health = ask();
  ASSERT_TRUE(health) << "the network answers";
  EXPECT_FALSE(health->alive || health->well || health->ready);
  EXPECT_EQ(health->faults.front().name, "simulation");
  still.unlock();
  EXPECT_TRUE(comes_to("/healthz", 200)) << "and when it goes on, that is said";
}

TEST_F(LiveHealthTest, a_server_that_speaks_no_http_answers_a_program) {
  start([](LiveConfig& config) {
    config.net.web.on = false;
    config.net.access.anonymous = std::nullopt;
    config.net.admin_token = "the-admin-token";
  });
  const auto health = ask();
  ASSERT_TRUE(health) << health.error().message;
  EXPECT_TRUE(health->well && health->ready);
  EXPECT_TRUE(holds(health_lines(*health), "healthy, ready, at tick "));
  AdminServer nowhere;
  nowhere.port = 1;
  EXPECT_FALSE(read_health(nowhere));
}

TEST_F(LiveHealthTest, a_log_of_events_that_cannot_be_written_is_a_fault_and_the_game_goes_on) {
  start([&](LiveConfig& config) { config.events_path = "/dev/full"; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(HelloMessage{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F}));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>());
  EXPECT_TRUE(comes_to("/healthz", 503)) << "the event of the session has no place on the disk";
  EXPECT_TRUE(holds(body("/healthz"), "\"name\":\"events\"")) << body("/healthz");
  EXPECT_EQ(status("/livez"), 200);
  EXPECT_EQ(status("/readyz"), 200);
}

TEST_F(LiveHealthTest, events_that_are_lost_at_the_end_are_said_once) {
  start([&](LiveConfig& config) { config.events_path = "/dev/full"; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(HelloMessage{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F}));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>());
  EXPECT_TRUE(comes_to("/healthz", 503));
  EXPECT_TRUE(holds(body("/healthz"), "the disk is full")) << body("/healthz");
  CapturedLog log;
  const auto stopped = server->stop();
  EXPECT_FALSE(stopped.has_value());
  server.reset();
  EXPECT_EQ(log.count("are lost (--events)"), 1U) << log.text();
}

/// What happens to the world's file, and passes.
class LiveHealthFaultTest : public LiveHealthTest, public ::testing::WithParamInterface<Fault> {
 protected:
  static const char* cause_of(Fault fault) {
    if (fault == Fault::held) return "another program holds the file";
    return fault == Fault::full ? "the disk is full" : "the disk fails";
  }
};

TEST_P(LiveHealthFaultTest, a_world_that_is_not_saved_is_said_until_it_is_saved_again) {
  FaultyDisk disk;
  const std::string world = folder / "w.world";
  start([&](LiveConfig& config) {
    config.world_path = world;
    config.durability = Durability::tick;
  });
  uint32_t carves = 0;
  const auto carve = [&] {
    CarveRequest request;
    request.shape = sphere({static_cast<float>(++carves % 9), 0.0F, 2.0F}, 1.0F);
    request.seeds = 1;
    static_cast<void>(server->push({0, carves, request}));
  };
  carve();
  EXPECT_TRUE(comes_to("/healthz", 200));
  PassingFault fault(GetParam(), disk, world);
  const auto is_told = [&] { return holds(body("/healthz"), "\"name\":\"saving\""); };
  for (const Within within(60.0); !is_told() && !within.over(); wait_a_moment()) carve();
  EXPECT_TRUE(is_told()) << body("/healthz");
  EXPECT_EQ(status("/healthz"), 503);
  EXPECT_FALSE(holds(body("/healthz"), world)) << "everybody may ask";
  EXPECT_TRUE(holds(body("/healthz"), cause_of(GetParam()))) << body("/healthz");
  EXPECT_EQ(status("/livez"), 200) << "a restart mends nothing";
  EXPECT_EQ(status("/readyz"), 200);
  fault.pass();
  EXPECT_TRUE(comes_to("/healthz", 200));
  EXPECT_TRUE(server->stop());
  server.reset();  // before the disk
}

INSTANTIATE_TEST_SUITE_P(Faults, LiveHealthFaultTest,
                         ::testing::Values(Fault::held, Fault::full, Fault::broken), name_of_fault);

TEST(Heartbeat, says_when_it_stands_still_again_and_again_and_when_it_goes_on) {
  Heartbeat heart(100.0, 5.0);
  EXPECT_FALSE(heart.check(104.0));
  EXPECT_FALSE(heart.stands_still(105.0));
  const auto first = heart.check(106.0);
  ASSERT_TRUE(first);
  EXPECT_TRUE(holds(*first, "stands still: no tick has ended for 6.0 s"));
  EXPECT_FALSE(heart.check(107.0)) << "once";
  EXPECT_TRUE(heart.check(106.0 + limits::still_line_seconds));
  heart.beat(170.0);
  const auto on = heart.check(170.1);
  ASSERT_TRUE(on);
  EXPECT_TRUE(holds(*on, "goes on, after"));
  EXPECT_FALSE(heart.check(171.0));
}

TEST(SaveDelay, counts_from_the_first_save_that_had_to_wait) {
  SaveDelay delay;
  SaverStatus status;
  const auto after = [&](double now_s) {
    delay.note(status, now_s);
    return delay.waited_s(now_s);
  };
  EXPECT_EQ(after(1.0), 0.0);
  status.saves = 1;
  EXPECT_EQ(after(100.0), 0.0) << "an idle world is not saved, and waits for nothing";
  status.skipped = 1;
  EXPECT_EQ(after(101.0), 0.0);
  status.skipped = 9;
  EXPECT_EQ(after(115.0), 14.0);
  status.saves = 2;
  EXPECT_EQ(after(116.0), 0.0);
}

}  // namespace
}  // namespace scree
