// Pieces that are enclosed in rock become terrain where they lie; none travels through rock.
#include <gtest/gtest.h>
#include <map>

#include "bench/support/travels.h"
#include "server/world/buried_stage.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"
#include "server/world/spawn.h"
#include "server/world/world.h"
#include "shared/field/piece.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

constexpr int burial_ticks_max = 3600;
constexpr float travel_max_m = 1.0F;

class Buried : public ::testing::TestWithParam<TerrainColliderKind> {
 protected:
  Buried() : world_(config()) {}

  static WorldConfig config() {
    WorldConfig config = flat_world();
    config.methods.collider = GetParam();
    return config;
  }

  std::shared_ptr<const TickDelta> step(std::vector<Command> commands = {}) {
    auto delta = world_.step(commands);
    travels_.observe(world_, *delta);
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const AppliedOperation& applied : delta->operations)
      if (std::holds_alternative<DiscardOperation>(applied.operation)) ++lost_;
    return delta;
  }
  void fill(const Shape& shape) {
    const auto delta = step({{1, ++request_, FillRequest{shape}}});
    ASSERT_EQ(delta->replies.at(0).refusal, "");
  }
  void carve(const Shape& shape, glm::vec3 impact_m, uint32_t seeds) {
    CarveRequest request;
    request.shape = shape;
    request.seeds = seeds;
    request.impact_m = impact_m;
    const auto delta = step({{1, ++request_, request}});
    ASSERT_EQ(delta->replies.at(0).refusal, "");
  }
  void expect_all_become_terrain() {
    auto delta = step();
    for (int tick = 0; tick < burial_ticks_max && !delta->pieces.empty(); ++tick) delta = step();
    EXPECT_TRUE(delta->pieces.empty()) << delta->pieces.size() << " are still alive";
    EXPECT_EQ(world_.measure_terrain(), delta->ledger.terrain);
    EXPECT_LE(travels_.farthest_m(), travel_max_m);
    EXPECT_EQ(lost_, 0) << "pieces left the world";
  }

  World world_;
  Travels travels_;
  uint32_t request_ = 0;
  int lost_ = 0;
};

TEST_P(Buried, a_block_that_falls_onto_its_rubble_leaves_no_piece_climbing_through_it) {
  fill(box({0.0F, 1.5F, 0.0F}, {1.0F, 1.5F, 1.0F}));
  fill(box({0.0F, 6.0F, 0.0F}, {4.0F, 3.0F, 4.0F}));
  carve(box({0.0F, 1.5F, 0.0F}, {1.5F, 1.4F, 1.5F}), {0.0F, 1.5F, 1.5F}, 64);
  expect_all_become_terrain();
}

TEST_P(Buried, a_ball_cut_at_its_foot_leaves_no_piece_climbing_through_it) {
  fill(capsule({0.0F, -1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}, 0.8F));
  fill(sphere({0.0F, 5.0F, 0.0F}, 3.5F));
  carve(sphere({0.0F, 1.0F, 0.0F}, 1.4F), {0.0F, 1.0F, 1.0F}, 64);
  expect_all_become_terrain();
}

TEST_P(Buried, rock_poured_over_living_pieces_takes_them_in) {
  carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 48);
  for (int tick = 0; tick < 20; ++tick) step();
  const auto before = step();
  ASSERT_GT(before->pieces.size(), 20U);
  const auto delta = step({{1, 9, FillRequest{sphere({0.0F, 0.0F, 0.0F}, 6.0F)}}});
  EXPECT_GT(delta->replies.at(0).pieces, before->pieces.size() / 2) << "the reply counts pieces taken in";
  expect_all_become_terrain();
}

TEST_P(Buried, with_recombination_off_they_stand_still) {
  step({{1, 1, SettingsRequest{{{"recombine", "off"}}}}});
  carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 24);
  for (int tick = 0; tick < 20; ++tick) step();
  fill(sphere({0.0F, 0.0F, 0.0F}, 6.0F));
  for (int tick = 0; tick < 300; ++tick) step();
  EXPECT_LE(travels_.farthest_m(), travel_max_m);
  EXPECT_EQ(lost_, 0);
}

TEST_P(Buried, with_recombination_off_they_fall_once_they_are_dug_free) {
  step({{1, 1, SettingsRequest{{{"recombine", "off"}}}}});
  carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 24);
  for (int tick = 0; tick < 20; ++tick) step();
  fill(sphere({0.0F, 0.0F, 0.0F}, 6.0F));
  std::map<PieceId, glm::vec3> lay_m;
  auto delta = step();
  for (const PieceState& piece : delta->pieces) lay_m[piece.id] = dequantise(piece.pose).position_m;
  carve(sphere({0.0F, 0.0F, 0.0F}, 4.0F), {0.0F, 0.0F, 0.0F}, 64);
  for (int tick = 0; tick < 120; ++tick) delta = step();
  size_t moved = 0;
  for (const PieceState& piece : delta->pieces) {
    const auto found = lay_m.find(piece.id);
    if (found == lay_m.end()) continue;
    const glm::vec3 way_m = dequantise(piece.pose).position_m - found->second;
    if (glm::dot(way_m, way_m) > 0.01F) ++moved;
  }
  EXPECT_GT(moved, lay_m.size() / 2) << "of " << lay_m.size();
}

/// The state of a flat world with balls that were cut out of the rock, and lie elsewhere.
class CutBalls : public ::testing::Test {
 protected:
  PieceId put_at(glm::vec3 place_m, float radius_m = 1.0F) {
    const PieceId ball = state.next_piece;
    const glm::vec3 from_m(-6.0F * static_cast<float>(ball), -6.0F, 0.0F);
    const Applied cut = state.apply_and_record(
        CarveOperation{sphere(from_m, radius_m), SeedPattern::uniform, 1, 1, from_m, ball}, 0, delta);
    state.enter_removed(cut);
    const auto elsewhere = [&](PieceId, const Volume&) {
      Newborn born;
      born.body.pose.position_m = place_m;
      return born;
    };
    spawn(state, cut, elsewhere, delta);
    return ball;
  }
  void look(Tick ticks = 60) {
    for (Tick tick = 0; tick < ticks; ++tick) {
      ++state.tick;
      merge_buried(state, delta);
    }
  }

  World::State state{flat_world(), 1};
  TickDelta delta;
};

TEST_F(CutBalls, in_rock_become_terrain_but_not_while_they_are_frozen) {
  const PieceId piece = put_at({12.0F, -6.0F, 0.0F});
  state.bodies.freeze(piece);
  look();
  EXPECT_TRUE(state.sunk.empty()) << "nobody looks at it";
  ASSERT_TRUE(state.pieces.contains(piece));
  state.bodies.thaw_all();
  look();
  EXPECT_FALSE(state.pieces.contains(piece));
}

TEST_F(CutBalls, that_are_in_rock_for_less_than_two_looks_stay_pieces) {
  const PieceId piece = put_at({12.0F, -6.0F, 0.0F});
  look(state.config.tick_rate_hz / limits::buried_scan_hz);
  ASSERT_TRUE(state.sunk.contains(piece)) << "it was looked at once";
  EXPECT_TRUE(state.pieces.contains(piece));
  look();
  EXPECT_FALSE(state.pieces.contains(piece));
}

TEST_F(CutBalls, take_dust_with_them_when_they_become_terrain) {
  const PieceId piece = put_at({12.0F, 1.0F, 0.0F});
  const MassUnits mass = state.ledger.pieces, dust = 2 * mass;
  state.ledger.dust = dust;
  state.materials = MaterialLedger(state.ledger, {{material::rock, mass}}, material::rock);
  merge_pieces(state, {piece}, delta);
  EXPECT_EQ(state.ledger.pieces, 0);
  EXPECT_LE(state.ledger.dust, dust - mass / 64);
  EXPECT_GE(state.ledger.dust, dust - mass / 32);
}

TEST_F(CutBalls, that_become_terrain_in_the_air_fall_once) {
  merge_pieces(state, {put_at({12.0F, 6.0F, 0.0F})}, delta);
  ASSERT_TRUE(state.pieces.empty());
  drop_islands(state, delta);
  ASSERT_EQ(state.pieces.size(), 1U);
  merge_pieces(state, {state.pieces.begin()->first}, delta);
  drop_islands(state, delta);
  EXPECT_TRUE(state.pieces.empty()) << "or it would fall for ever";
}

TEST_F(CutBalls, in_the_volume_of_a_larger_one_become_terrain_before_it) {
  const PieceId large = put_at({12.0F, 1.0F, 0.0F}, 1.5F), small = put_at({12.5F, 0.8F, 0.0F}, 0.5F);
  const PieceId beside = put_at({12.0F, 1.0F, 5.0F}, 0.5F);
  delta.operations.clear();
  merge_pieces(state, {large}, delta);
  ASSERT_EQ(delta.operations.size(), 2U);
  EXPECT_EQ(pieces_ended_by(delta.operations[0].operation), std::vector<PieceId>{small});
  EXPECT_EQ(pieces_ended_by(delta.operations[1].operation), std::vector<PieceId>{large});
  EXPECT_TRUE(state.pieces.contains(beside));
}

std::string name_of_collider(const ::testing::TestParamInfo<TerrainColliderKind>& info) {
  return std::vector<std::string>{"field", "mesh", "rays"}.at(static_cast<size_t>(info.param));
}

INSTANTIATE_TEST_SUITE_P(colliders, Buried,
                         ::testing::Values(TerrainColliderKind::field, TerrainColliderKind::mesh,
                                           TerrainColliderKind::rays),
                         name_of_collider);

}  // namespace
}  // namespace scree
