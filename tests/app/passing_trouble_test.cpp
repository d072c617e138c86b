// A whole server whose files are held, full or gone for a while: it goes on, says so, saves and records all
// that it promised, and starts again with the same files. And: limits of the machine are what it is told.
#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/app/live_server.h"
#include "server/replay/verify.h"
#include "server/store/database.h"
#include "server/store/recording_parts.h"
#include "server/store/recording_reader.h"
#include "server/store/world_file.h"
#include "server/world/settings.h"
#include "tests/support/captured_log.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class PassingTroubleTest : public ::testing::Test {
 protected:
  void SetUp() override {
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
    config.world_path = world_path;
    config.durability = Durability::tick;
  }
  void start() {
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
  }
  void carve() {
    CarveRequest carve;
    const auto place = static_cast<float>(++carves_ % 9);
    carve.shape = sphere({place, 0.0F, 2.0F}, 1.0F);
    carve.seeds = 4;
    carve.impact_m = {place, 1.0F, 2.0F};
    ASSERT_TRUE(server->push({0, carves_, carve}));
    ASSERT_TRUE(server->step_once());
    carved_at_ = server->last_delta()->tick;
  }
  template <typename Condition>
  bool steps_until(const Condition& is_so) {
    const auto deadline = Clock::now() + std::chrono::seconds(30);
    while (!is_so() && Clock::now() < deadline) {
      if (!server->step_once()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
    return is_so();
  }
  nlohmann::json report() const { return nlohmann::json::parse(to_json(server->report())); }
  /// The last carve.
  bool is_saved() const {
    const SaverStatus status = server->report().saving;
    return status.health.ok() && status.saved_tick >= carved_at_;
  }
  uint64_t field_hash() const { return server->world()->field().hash(); }
  void stop() {
    const auto stopped = server->stop();
    EXPECT_TRUE(stopped.has_value()) << stopped.error().message;
    server.reset();
  }
  static Tick verified(const std::string& part) {
    auto reader = RecordingReader::open(part);
    EXPECT_TRUE(reader.has_value()) << reader.error().message;
    if (!reader) return 0;
    const auto done = verify(**reader);
    EXPECT_TRUE(done && done->agrees()) << (done ? done->difference : done.error().message);
    return done && done->agrees() ? (*reader)->last_tick() : 0;
  }

  const TestFolder folder;
  const std::string world_path = folder / "w.world", recording = folder / "session.scree";
  LiveConfig config;
  std::unique_ptr<LiveServer> server;

 private:
  uint32_t carves_ = 0;
  Tick carved_at_ = 0;
};

TEST_F(PassingTroubleTest, a_held_world_is_saved_when_it_is_let_go_and_the_status_says_so_meanwhile) {
  start();
  carve();
  ASSERT_TRUE(steps_until([&] { return is_saved(); }));
  EXPECT_EQ(report()["world"]["state"], "ok");
  auto holder = Database::open(world_path);
  ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE").has_value());
  for (int i = 0; i < 3; ++i) carve();
  ASSERT_TRUE(steps_until([&] { return !server->report().saving.health.ok(); }));
  const auto told = report()["world"];
  EXPECT_EQ(told["state"], "retrying");
  EXPECT_TRUE(holds(told["error"].get<std::string>(), "another program holds the file")) << told;
  EXPECT_EQ(told["since"].get<std::string>().back(), 'Z');
  EXPECT_FALSE(server->report().error.has_value()) << "a trouble that may pass is no end";
  ASSERT_TRUE(holder->execute("COMMIT").has_value());
  ASSERT_TRUE(steps_until([&] { return is_saved(); }));
  EXPECT_EQ(report()["world"]["state"], "ok");
  const uint64_t hash = field_hash();
  stop();
  start();
  EXPECT_EQ(field_hash(), hash);
}

TEST_F(PassingTroubleTest, a_world_that_stays_held_ends_the_server_with_words_and_its_file_goes_on) {
  start();
  carve();
  ASSERT_TRUE(steps_until([&] { return is_saved(); }));
  auto holder = Database::open(world_path);
  ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE").has_value());
  carve();
  const auto stopped = server->stop();
  ASSERT_FALSE(stopped.has_value());
  EXPECT_TRUE(holds(stopped.error().message, "its file holds tick")) << stopped.error().message;
  ASSERT_TRUE(holder->execute("COMMIT").has_value());
  server.reset();
  start();
}

TEST_F(PassingTroubleTest, a_world_that_nobody_touched_is_not_lost_while_its_file_is_held) {
  start();
  ASSERT_TRUE(server->step_once());
  // The first tick has the settings.
  ASSERT_TRUE(steps_until([&] { return server->report().saving.saved_tick >= 1; }));
  auto holder = Database::open(world_path);
  ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE").has_value());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(server->step_once());
  CapturedLog log;
  const auto stopped = server->stop();
  EXPECT_TRUE(stopped.has_value()) << stopped.error().message;
  EXPECT_TRUE(holds(log.text(), "nothing has changed since tick")) << log.text();
  EXPECT_FALSE(holds(log.text(), "not saved")) << log.text();
}

TEST_F(PassingTroubleTest,
       files_that_are_removed_while_the_server_runs_are_there_again_and_so_is_the_next_start) {
  config.record_path = recording;
  start();
  for (int i = 0; i < 5; ++i) carve();
  ASSERT_TRUE(steps_until([&] { return is_saved(); }));
  for (const std::string& path : {world_path, recording})
    for (const char* end : {"", "-wal", "-shm"}) fs::remove(path + end);
  carve();
  ASSERT_TRUE(steps_until([&] { return fs::exists(world_path) && is_saved(); }));
  ASSERT_TRUE(
      steps_until([&] { return server->report().recording.ok() && server->report().recording.lost > 0; }));
  carve();
  ASSERT_TRUE(server->step_once());
  const uint64_t hash = field_hash();
  const Tick last = server->last_delta()->tick;
  stop();
  EXPECT_EQ(verified(recording), last) << "its name was free";
  start();
  EXPECT_EQ(field_hash(), hash);
  EXPECT_EQ(server->report().record_path, recording);
  carve();
  stop();
  EXPECT_EQ(verified(recording), last + 1);
}

TEST_F(PassingTroubleTest, a_start_goes_on_beside_a_recording_that_its_world_has_outrun) {
  config.record_path = recording;
  start();
  carve();
  stop();
  config.record_path.clear();
  start();
  carve();
  stop();
  config.record_path = recording;
  start();
  EXPECT_EQ(server->report().record_path, recording_part(recording, 2));
  carve();
  const Tick last = server->last_delta()->tick;
  stop();
  EXPECT_EQ(verified(recording), 1U);
  EXPECT_EQ(verified(recording_part(recording, 2)), last);
}

TEST_F(PassingTroubleTest, limits_of_the_machine_win_over_those_that_a_world_has_saved_and_others_do_not) {
  config.record_path = recording;
  config.world.service.sessions_max = 12;
  start();
  carve();
  stop();
  config.world.service.sessions_max = 7;
  config.world.memory_max_mb = 512;
  config.world.methods.impacts = false;
  config.machine_limits = {{"sessions-max", "7"}, {"memory-max", "512"}};
  start();
  carve();
  const WorldConfig& now = server->world()->config();
  EXPECT_EQ(now.service.sessions_max, 7U);
  EXPECT_EQ(now.memory_max_mb, 512U);
  EXPECT_TRUE(now.methods.impacts) << "how rock breaks is the world's";
  stop();
  config.machine_limits.clear();
  config.world = {};
  config.world.terrain = flat_terrain;
  start();
  carve();
  EXPECT_EQ(server->world()->config().service.sessions_max, 7U) << "nobody said otherwise";
  const Tick last = server->last_delta()->tick;
  stop();
  EXPECT_EQ(verified(recording), last) << "the change is a command of the recording";
}

}  // namespace
}  // namespace scree
