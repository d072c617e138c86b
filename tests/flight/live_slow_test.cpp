// What a running server says of slow ticks that were made slow: by a carver, a disk, a network thread that is
// held up, and a process that was stopped.
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <mutex>

#include "bench/support/server_process.h"
#include "client/admin/admin.h"
#include "server/app/live_server.h"
#include "server/store/database.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr const char* token = "the-admin-token";

class LiveSlow : public ::testing::Test {
 protected:
  void start(const std::function<void(LiveConfig&)>& change) {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.sim_threads = 1;
    config.net.admin_token = token;
    change(config);
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
    port = server->port();
  }
  Result<AdminListMessage> ask(const ListFlightRequest& request) const {
    AdminServer target;
    target.port = port;
    target.token = token;
    return list_flight(target, request);
  }
  /// Does something again and again until a row is what was meant.
  bool comes(const ListFlightRequest& request, const std::function<bool(const SlowTickRow&)>& is_it,
             const std::function<void()>& again = {}) {
    for (const Within within(60.0); !within.over(); wait_a_moment()) {
      if (again) again();
      const auto list = ask(request);
      EXPECT_TRUE(list) << list.error().message;
      if (!list) return false;
      for (const SlowTickRow& row : list->slow_ticks)
        if (is_it(row)) return true;
      said = slow_ticks_lines(*list);
    }
    return false;
  }

  TestFolder folder;
  std::unique_ptr<LiveServer> server;
  uint16_t port = 0;
  std::string said;
};

TEST_F(LiveSlow, a_carve_is_its_sessions_with_kind_place_time_and_price) {
  start([](LiveConfig&) {});
  AdminServer target;
  target.port = port;
  target.token = token;
  const auto carve = [&] {
    CarveRequest request{.shape = sphere({4.0F, -1.0F, 0.0F}, 5.0F)};
    request.seeds = 64;
    static_cast<void>(ask_world(target, request));
  };
  const auto is_it = [](const SlowTickRow& row) {
    return row.culprit == "work" && row.request == "carve" && row.session != 0 && row.clock_ms > 0.0F &&
           row.price_ms > 0.0F && row.place_m == glm::vec3(4.0F, -1.0F, 0.0F);
  };
  EXPECT_TRUE(comes({FlightList::worst, 0, 20}, is_it, carve)) << said;
  const auto parties = ask({FlightList::parties, 0, 0});
  ASSERT_TRUE(parties);
  const auto works = [](const PartyRow& row) { return row.clock_us_per_s > 0.0F && row.requests > 0; };
  EXPECT_TRUE(std::ranges::any_of(parties->parties, works)) << parties_lines(*parties);
}

TEST_F(LiveSlow, a_disk_that_takes_no_save_is_named) {
  const std::string world = folder / "hill.world";
  start([&](LiveConfig& config) {
    config.world_path = world;
    config.slow = {60'000.0, 500.0};
  });
  auto holder = Database::open(world);
  ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE"));
  const auto is_it = [](const SlowTickRow& row) {
    return row.culprit == "disk" && holds(row.words, "a save took");
  };
  EXPECT_TRUE(comes({}, is_it)) << said;
  EXPECT_TRUE(holder->execute("COMMIT"));
}

TEST_F(LiveSlow, a_network_thread_that_is_held_up_is_named) {
  std::mutex gate;
  std::unique_lock closed(gate);
  start([&](LiveConfig& config) {
    config.slow.late_ms = 100.0;
    config.hooks.joined = [&](const JoinedPerson&) { const std::scoped_lock pass(gate); };
  });
  std::thread visitor([&] { static_cast<void>(ask({})); });
  const uint64_t from = server->report().ticks;
  for (const Within within(60.0); server->report().ticks < from + 60 && !within.over();) wait_a_moment();
  closed.unlock();
  visitor.join();
  const auto is_it = [](const SlowTickRow& row) {
    return row.culprit == "network" && holds(row.words, "starved");
  };
  EXPECT_TRUE(comes({}, is_it)) << said;
}

TEST_F(LiveSlow, a_process_that_was_stopped_did_not_run) {
  ServerProcess process(SCREE_SERVER_PROGRAM, {"--admin-token", token, "--slow-ms", "200"}, 60.0);
  port = process.port();
  ASSERT_NE(port, 0);
  ASSERT_TRUE(ask({}));
  ::kill(process.process(), SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  ::kill(process.process(), SIGCONT);
  const auto is_it = [](const SlowTickRow& row) {
    return row.culprit == "not_running" && row.late_ms > 500.0F;
  };
  EXPECT_TRUE(comes({}, is_it)) << said;
  EXPECT_EQ(process.end(SIGTERM, 60.0), 0);
}

}  // namespace
}  // namespace scree
