// Two recordings that differ in one command, one voxel or one body: the first tick, the stage and the place.
#include "server/replay/recording_diff.h"

#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <tuple>

#include "tests/support/holds.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class RecordingDiffTest : public RecordingTest {
 protected:
  using Change = std::function<void(Tick tick, World& world, std::vector<Command>& commands)>;
  using Tamper = std::function<void(TickDelta& delta)>;

  /// A recorded session; returns its file.
  std::string session(const std::string& name, Tick ticks, const Change& change = {},
                      const Tamper& tamper = {}) {
    deltas.clear();
    commands_by_tick.clear();
    World world(small_world());
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick == 10) commands = {carve_at(0.0F, 1)};
      if (change) change(tick, world, commands);
      TickDelta delta = *world.step(commands);
      if (tamper) tamper(delta);
      deltas.push_back(std::make_shared<const TickDelta>(std::move(delta)));
      commands_by_tick.push_back(std::move(commands));
    }
    path = (folder / name).string();
    record();
    return path;
  }
  static RecordingDiff compared(const std::string& a, const std::string& b) {
    const auto found = diff({a, {}}, {b, {}});
    EXPECT_TRUE(found.has_value()) << found.error().message;
    return found ? *found : RecordingDiff{};
  }
  static std::string text_of(const RecordingDiff& diff, DiffStage stage) {
    for (const StageDifference& difference : diff.stages)
      if (difference.stage == stage) return difference.text;
    return "no difference";
  }
};

TEST_F(RecordingDiffTest, a_session_simulated_twice_is_the_same) {
  const RecordingDiff found = compared(session("a", 70), session("b", 70));
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.tick, 0U);
  EXPECT_EQ(found.last, 70U);
}

TEST_F(RecordingDiffTest, a_changed_command_is_named_and_what_it_did_to_the_field) {
  const std::string a = session("a", 40);
  const std::string b = session("b", 40, [](Tick tick, World&, std::vector<Command>& commands) {
    if (tick == 10) std::get<CarveRequest>(commands[0].body).shape.radius_m = 1.25F;
  });
  const RecordingDiff found = compared(a, b);
  EXPECT_EQ(found.tick, 10U);
  const std::string commands = text_of(found, DiffStage::commands);
  EXPECT_TRUE(
      holds(commands, "session 1, request 1: carve a sphere at (0.000, 0.000, 0.000) m, radius 1.000 m"))
      << commands;
  EXPECT_TRUE(holds(commands, "radius 1.250 m")) << commands;
  const std::string field = text_of(found, DiffStage::field);
  EXPECT_TRUE(holds(field, "chunk ") && holds(field, "brick ") && holds(field, ") m")) << field;
  EXPECT_TRUE(holds(text_of(found, DiffStage::ledger), "terrain ")) << text_of(found, DiffStage::ledger);
}

/// Changes a brick of a recording from tick 71 on, until the world changes it itself: as if memory had lost a
/// bit. No command says so.
class FlippedBrick {
 public:
  FlippedBrick(BrickCoord coord, std::function<void(Brick&)> flip) : coord_(coord), flip_(std::move(flip)) {}

  void operator()(TickDelta& delta) {
    const auto of_world = std::ranges::find(delta.bricks, coord_, &BrickState::coord);
    if (of_world != delta.bricks.end()) {
      known_ = *of_world;
      hash_gain_ = 0;
    }
    if (delta.tick == 71) put(delta);
    delta.field_hash += hash_gain_;
  }

 private:
  void put(TickDelta& delta) {
    Brick brick = known_ ? *known_->brick : MapField(small_world().terrain).brick(coord_);
    flip_(brick);
    const uint64_t hash = brick_hash(coord_, brick);
    hash_gain_ = hash - (known_ ? known_->hash : 0);
    std::erase_if(delta.bricks, [&](const BrickState& state) { return state.coord == coord_; });
    delta.bricks.push_back({coord_, std::make_shared<const Brick>(brick), hash, {}});
    std::ranges::sort(delta.bricks, {}, &BrickState::coord);
  }

  BrickCoord coord_;
  std::function<void(Brick&)> flip_;
  std::optional<BrickState> known_;  ///< as the world has it; none while it is not edited
  uint64_t hash_gain_ = 0;
};

TEST_F(RecordingDiffTest, a_flipped_voxel_is_named_with_its_brick_and_its_place) {
  constexpr BrickCoord brick{-10, -1, 3};
  const std::string a = session("a", 130);
  const FlippedBrick flipped(brick, [](Brick& bytes) {
    Code& code = bytes.codes[static_cast<size_t>(Brick::index(1, 2, 3))];
    code = static_cast<Code>(-code);
  });
  const RecordingDiff found = compared(a, session("b", 130, {}, flipped));
  EXPECT_EQ(found.tick, 71U);
  const std::string field = text_of(found, DiffStage::field);
  EXPECT_TRUE(holds(field, "chunk -3 -1 0, brick -10 -1 3")) << field;
  EXPECT_EQ(text_of(found, DiffStage::commands), "no difference");
}

TEST_F(RecordingDiffTest, a_voxel_of_a_brick_that_both_edited_is_named_with_both_codes) {
  // A fill edits a brick that nothing changes after it: pieces of the carve merge elsewhere.
  const auto fill = [](Tick tick, World&, std::vector<Command>& commands) {
    if (tick == 20) commands.push_back({.body = FillRequest{sphere({-7.0F, 0.0F, -7.0F}, 1.0F)}});
  };
  std::set<std::tuple<int, int, int>> candidates;
  const std::string a = session("a", 130, fill, [&](TickDelta& delta) {
    for (const BrickState& state : delta.bricks) {
      const std::tuple at{state.coord.x, state.coord.y, state.coord.z};
      if (delta.tick <= 60)
        candidates.insert(at);
      else
        candidates.erase(at);
    }
  });
  ASSERT_FALSE(candidates.empty());
  const auto [x, y, z] = *candidates.begin();
  const BrickCoord brick{x, y, z};
  const FlippedBrick flipped(
      brick, [](Brick& bytes) { bytes.codes[77] = static_cast<Code>(bytes.codes[77] == 5 ? 6 : 5); });
  const RecordingDiff found = compared(a, session("b", 130, fill, flipped));
  EXPECT_EQ(found.tick, 71U);
  const std::string field = text_of(found, DiffStage::field);
  const std::string named = "brick " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) +
                            ": voxel " + std::to_string(8 * x + 1) + " " + std::to_string(8 * y + 1) + " " +
                            std::to_string(8 * z + 5) + " at (";
  EXPECT_TRUE(holds(field, named)) << field;
  EXPECT_TRUE(holds(field, "in the other 5") || holds(field, "in the other 6")) << field;
}

TEST_F(RecordingDiffTest, a_moved_body_is_named_with_both_places) {
  const std::string a = session("a", 30);
  PieceId moved = 0;
  const std::string b = session("b", 30, {}, [&](TickDelta& delta) {
    if (delta.tick != 20) return;
    ASSERT_FALSE(delta.pieces.empty());
    moved = delta.pieces[1].id;
    Pose pose = dequantise(delta.pieces[1].pose);
    pose.position_m.y += 0.5F;
    delta.pieces[1].pose = quantise(pose);
    delta.state_hash ^= 1U;
  });
  const RecordingDiff found = compared(a, b);
  EXPECT_EQ(found.tick, 20U);
  ASSERT_EQ(found.stages.size(), 1U);
  EXPECT_EQ(found.stages[0].stage, DiffStage::bodies);
  EXPECT_TRUE(holds(found.stages[0].text, "piece " + std::to_string(moved) + " is at ("))
      << found.stages[0].text;
}

TEST_F(RecordingDiffTest, a_movement_below_what_poses_say_is_followed_to_where_it_shows) {
  const std::string a = session("a", 30);
  const std::string b = session("b", 30, {}, [](TickDelta& delta) {
    if (delta.tick >= 20) delta.state_hash ^= 1U;
    if (delta.tick < 23 || delta.pieces.empty()) return;
    Pose pose = dequantise(delta.pieces[0].pose);
    pose.position_m.x += 0.25F;
    delta.pieces[0].pose = quantise(pose);
  });
  const RecordingDiff found = compared(a, b);
  EXPECT_EQ(found.tick, 20U);
  const std::string bodies = text_of(found, DiffStage::bodies);
  EXPECT_TRUE(holds(bodies, "seen first at tick 23: piece ")) << bodies;
}

TEST_F(RecordingDiffTest, a_setting_that_changes_in_one_is_named) {
  const std::string a = session("a", 15);
  const std::string b = session("b", 15, [](Tick tick, World&, std::vector<Command>& commands) {
    if (tick == 12) commands = {{1, 1, SettingsRequest{{{"impacts", "false"}}}}};
  });
  const RecordingDiff found = compared(a, b);
  EXPECT_EQ(found.tick, 12U);
  EXPECT_EQ(text_of(found, DiffStage::settings), "impacts=true, in the other false");
}

TEST_F(RecordingDiffTest, one_that_ends_earlier_differs_where_it_ends) {
  const RecordingDiff found = compared(session("a", 20), session("b", 15));
  EXPECT_EQ(found.tick, 16U);
  ASSERT_EQ(found.stages.size(), 1U);
  EXPECT_EQ(found.stages[0].stage, DiffStage::extent);
}

TEST_F(RecordingDiffTest, what_is_no_recording_is_an_error) {
  const std::string a = session("a", 3);
  EXPECT_FALSE(diff({a, {}}, {(folder / "none").string(), {}}).has_value());
}

}  // namespace
}  // namespace scree
