// Who joins after pieces merged, and after a restart of the server, sees the stones of those who were there.
#include <gtest/gtest.h>

#include "client/mirror/mirror.h"
#include "client/render/scene/settled_stones.h"
#include "proto/codec.h"
#include "server/publish/publisher.h"
#include "server/store/world_file.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "tests/support/flat_welcome.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

/// A viewer without a picture.
class Watcher {
 public:
  explicit Watcher(const WelcomeMessage& welcome) : mirror_(welcome) {}

  void receive(const std::vector<uint8_t>& bytes) {
    const auto message = decode_server(std::span(bytes).subspan(length_prefix_bytes));
    ASSERT_TRUE(message.has_value()) << message.error().message;
    if (std::holds_alternative<StoneMessage>(*message)) {
      ++stones_told;
      stone_bytes += bytes.size();
    }
    joined_bytes += bytes.size();
    auto changes = mirror_.apply(*message);
    ASSERT_TRUE(changes.has_value()) << changes.error().message;
    ScenePieces pieces;
    for (const auto& [id, motion] : mirror_.pieces()) pieces[id] = {motion.volume, motion.to};
    stones.step(pieces, mirror_.field(), {0.0F, 5.0F, 0.0F}, *changes);
  }

  SettledStones stones;
  size_t stones_told = 0, stone_bytes = 0, joined_bytes = 0;

 private:
  Mirror mirror_;
};

/// A server without sockets.
class Stage {
 public:
  explicit Stage(std::unique_ptr<World> world) : world_(std::move(world)) {
    publisher_.begin(world_->keyframe());
  }
  World& world() { return *world_; }

  Watcher& join(uint64_t session) {
    publisher_.join(session, {0.0F, 5.0F, 0.0F}, 60.0F, operation_kinds);
    publisher_.want_stones(session, true);
    WelcomeMessage welcome;
    welcome.terrain = world_->config().terrain;
    welcome.tick = world_->tick();
    return watchers_.try_emplace(session, welcome).first->second;
  }
  void tick(const std::vector<Command>& commands = {}) {
    const auto delta = world_->step(commands);
    for (const Outgoing& each : publisher_.publish(*delta, [](uint64_t) { return Backlog(); }))
      if (const auto watcher = watchers_.find(each.session); watcher != watchers_.end())
        watcher->second.receive(*each.bytes);
  }
  void ticks(int count) {
    for (int tick_now = 0; tick_now < count; ++tick_now) tick();
  }
  void settle() {
    for (int left = settle_ticks_max; left > 0 && !world_->moment().pieces.empty(); --left) tick();
    ticks(10);
  }

 private:
  std::unique_ptr<World> world_;
  Workers workers_{1};
  Publisher publisher_{PublisherConfig{.terrain = rock_terrain}, workers_};
  std::map<uint64_t, Watcher> watchers_;
};

std::vector<Command> blow(float x_m, uint32_t seeds) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 0.0F, 0.0F}, 2.0F);
  carve.seeds = seeds;
  carve.random_seed = 3;
  carve.impact_m = {x_m, 1.0F, 0.0F};
  return {{1, 1, carve}};
}

void expect_same_stones(const Watcher& one, const Watcher& other) {
  const ScenePieces &a = one.stones.shown(), &b = other.stones.shown();
  ASSERT_EQ(one.stones.count(), other.stones.count());
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [id, stone] : a) {
    ASSERT_TRUE(b.contains(id));
    const ScenePiece& same = b.at(id);
    EXPECT_LT(glm::distance(stone.pose.position_m, same.pose.position_m), 0.003F);
    EXPECT_GT(std::abs(glm::dot(stone.pose.rotation, same.pose.rotation)), 0.9999F);
    EXPECT_EQ(stone.volume->window.codes, same.volume->window.codes);
  }
}

class LateStonesTest : public testing::Test {
 protected:
  void SetUp() override {
    early = &stage.join(1);
    stage.ticks(3);
    stage.tick(blow(0.0F, 40));
    stage.settle();
    ASSERT_GE(early->stones.count(), 8U);
  }

  Stage stage{std::make_unique<World>(rock_world())};
  Watcher* early = nullptr;
};

TEST_F(LateStonesTest, who_joins_late_has_the_stones_of_who_was_there_and_loses_the_same) {
  EXPECT_EQ(early->stones_told, 0U);
  const Watcher& late = stage.join(2);
  stage.ticks(120);
  EXPECT_EQ(late.stones_told, early->stones.count());
  expect_same_stones(*early, late);
  const size_t before = early->stones.count();
  const glm::vec3 at_m = early->stones.shown().begin()->second.pose.position_m;
  CarveRequest carve;
  carve.shape = sphere(at_m, 1.5F);
  carve.seeds = 1;
  carve.impact_m = at_m;
  stage.tick({{1, 2, carve}});
  stage.ticks(3);
  EXPECT_LT(early->stones.count(), before);
  EXPECT_EQ(late.stones.count(), early->stones.count());
}

TEST_F(LateStonesTest, a_restarted_server_tells_the_same_stones) {
  const TestFolder folder;
  const std::string path = folder / "world.scree";
  const WorldSnapshot value = stage.world().snapshot();
  WorldHeader header{.world = 77, .config = value.moment.config};
  header.config.program = "test";
  ASSERT_TRUE(WorldFile::create(path, header, value).has_value());
  const auto file = WorldFile::open(path);
  ASSERT_TRUE(file.has_value());
  const auto rows = (*file)->read();
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  auto world = World::restore(rows->world);
  ASSERT_TRUE(world.has_value()) << world.error().message;
  Stage again(std::move(*world));
  const Watcher& late = again.join(2);
  again.ticks(120);
  expect_same_stones(*early, late);
}

}  // namespace
}  // namespace scree
