// Odd input, one test each: whatever is asked, no mass is made or lost. The ledger is checked after every
// tick, and the terrain measured afresh in the end.
#include <algorithm>
#include <gtest/gtest.h>

#include "bench/support/scenes.h"
#include "server/world/world.h"
#include "shared/base/limits.h"
#include "shared/field/edit.h"
#include "shared/fracture/polygon_cut.h"
#include "tests/support/flat_world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

WorldConfig world_for(uint32_t pieces_max = 8000) {
  WorldConfig config = flat_world();
  config.pieces_max = pieces_max;
  return config;
}

Command carve(const Shape& shape, uint32_t seeds, float blast_speed_m_s = 6.0F, uint32_t request = 1) {
  CarveRequest carve;
  carve.shape = shape;
  carve.pattern = SeedPattern::uniform;
  carve.seeds = seeds;
  carve.random_seed = 5;
  carve.impact_m = centre_of(shape) + glm::vec3(0.0F, reach_of(shape), 0.0F);
  carve.blast_speed_m_s = blast_speed_m_s;
  return {1, request, carve};
}

Command fill(const Shape& shape) {
  return {1, 9, FillRequest{shape}};
}

template <typename T>
int64_t count_of(const TickDelta& delta) {
  return std::ranges::count_if(delta.operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<T>(applied.operation);
  });
}

class OddInput : public ::testing::Test {
 protected:
  std::shared_ptr<const TickDelta> step(const std::vector<Command>& commands = {}) {
    auto delta = world->step(commands);
    EXPECT_EQ(delta->ledger.error(), 0);
    return delta;
  }
  void start(const WorldConfig& config) { world = std::make_unique<World>(config); }
  void TearDown() override {
    const auto delta = step();
    EXPECT_EQ(world->measure_terrain(), delta->ledger.terrain);
  }

  std::unique_ptr<World> world = std::make_unique<World>(world_for());
};

TEST_F(OddInput, carve_in_air) {
  const auto delta = step({carve(sphere({0.0F, 20.0F, 0.0F}, 2.0F), 16)});
  EXPECT_EQ(delta->replies[0].refusal, "");
  EXPECT_EQ(delta->replies[0].pieces, 0U);
  EXPECT_TRUE(delta->bricks.empty());
  EXPECT_EQ(delta->ledger, Ledger{});
}

TEST_F(OddInput, a_shape_of_no_known_kind_whatever_its_seeds) {
  for (const SeedPattern pattern : all_kinds<SeedPattern>) {
    CarveRequest carve;
    carve.shape = sphere({}, 1.0F);
    carve.shape.kind = static_cast<ShapeKind>(9);
    carve.pattern = pattern;
    World world{WorldConfig()};
    const auto delta = world.step({{{1, 1, carve}}});
    ASSERT_EQ(delta->replies.size(), 1U);
    EXPECT_EQ(delta->replies[0].reason, Refusal::carve_invalid) << name_of(pattern);
  }
}

TEST_F(OddInput, carve_of_no_volume) {
  const auto delta =
      step({carve(sphere({}, 0.0F), 4, 6.0F, 1), carve(box({}, {1.0F, 0.0F, 1.0F}), 4, 6.0F, 2),
            carve(capsule({}, {0.0F, 0.0F, 0.0F}, 0.0F), 4, 6.0F, 3)});
  ASSERT_EQ(delta->replies.size(), 3U);
  for (const Reply& reply : delta->replies) EXPECT_NE(reply.refusal, "") << "request " << reply.request;
  EXPECT_EQ(delta->field_hash, 0U);
  EXPECT_EQ(delta->ledger, Ledger{});
}

TEST_F(OddInput, carve_of_less_than_a_piece) {
  const auto delta = step({carve(sphere({0.1F, 0.0F, 0.1F}, 0.2F), 4)});
  EXPECT_EQ(delta->replies[0].refusal, "");
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_GT(delta->ledger.dust, 0);
  EXPECT_LT(delta->ledger.dust, limits::piece_mass_min);
  EXPECT_EQ(delta->ledger.terrain, -delta->ledger.dust);
}

TEST_F(OddInput, one_seed) {
  const auto delta = step({carve(sphere({0.0F, -1.0F, 0.0F}, 2.0F), 1)});
  ASSERT_EQ(delta->spawned.size(), 1U);
  EXPECT_EQ(mass_of(delta->spawned), delta->ledger.moved);
}

TEST_F(OddInput, four_thousand_and_ninety_six_seeds) {
  auto delta = step({carve(sphere({0.0F, -4.0F, 0.0F}, 5.0F), limits::seeds_max)});
  EXPECT_EQ(delta->replies[0].refusal, "");
  EXPECT_GT(delta->pieces.size(), 0U);
  EXPECT_GT(delta->work.refractures_put_off, 0U) << "it is cut on in later ticks";
  size_t most = 0;
  for (int tick = 0; tick < 300 && most <= 500 && delta->work.refractures_put_off > 0; ++tick) {
    delta = step();
    EXPECT_EQ(delta->ledger.error(), 0);
    most = std::max(most, delta->pieces.size());
  }
  EXPECT_GT(most, 500U);
  EXPECT_LE(most, limits::seeds_max);
  EXPECT_NE(step({carve(sphere({40.0F, 0.0F, 0.0F}, 2.0F), limits::seeds_max + 1)})->replies[0].refusal, "");
}

TEST_F(OddInput, an_edit_too_small_for_the_voxels_is_told_the_least_size) {
  WorldConfig coarse = world_for();
  coarse.terrain.voxel_size_m = limits::voxel_size_max_m;
  start(coarse);
  const glm::vec3 at_m(0.7F, 0.4F, -0.6F);
  for (const Command& small : {carve(sphere(at_m, 1.0F), 4), fill(sphere(at_m, 1.0F))}) {
    const auto delta = step({small});
    EXPECT_NE(delta->replies[0].refusal.find("ask for 1.5"), std::string::npos) << delta->replies[0].refusal;
    EXPECT_TRUE(delta->operations.empty());
  }
  const auto delta =
      step({carve(sphere(at_m, 1.5F), 4), fill(sphere(at_m + glm::vec3(20.0F, 0.0F, 0.0F), 1.5F))});
  for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "");
  EXPECT_EQ(delta->operations.size(), 2U);
  EXPECT_NE(delta->ledger.moved, 0);
  EXPECT_NE(delta->ledger.poured, 0);
}

TEST_F(OddInput, more_seeds_than_there_is_room_for) {
  const auto delta = step({carve(sphere({0.0F, -0.2F, 0.0F}, 0.5F), 1000)});
  EXPECT_EQ(delta->replies[0].refusal, "");
  EXPECT_GT(delta->spawned.size(), 0U);
  EXPECT_LT(delta->pieces.size(), 60U);
  EXPECT_EQ(delta->ledger.pieces + delta->ledger.dust, delta->ledger.moved);
}

/// Two posts, and a carve that takes the middle of both: what it takes hangs together nowhere.
TEST_F(OddInput, volume_split_in_two_by_the_carve) {
  for (const uint32_t seeds : {1U, 2U, 7U}) {
    start(world_for());
    step({fill(box({-1.5F, 3.0F, 0.0F}, {0.5F, 3.2F, 0.5F})),
          fill(box({1.5F, 3.0F, 0.0F}, {0.5F, 3.2F, 0.5F}))});
    auto delta = step({carve(box({0.0F, 2.0F, 0.0F}, {3.0F, 0.5F, 1.0F}), seeds)});
    EXPECT_GE(delta->replies[0].pieces, 1U);
    EXPECT_EQ(count_of<IslandOperation>(*delta), 2) << "the tops of both posts fall";
    EXPECT_EQ(mass_of(delta->spawned) + delta->ledger.dust, delta->ledger.moved);
    for (int tick = 0; tick < 300; ++tick) delta = step();
    EXPECT_EQ(world->measure_terrain(), delta->ledger.terrain);
  }
}

TEST_F(OddInput, pieces_that_leave_the_world) {
  const float edge_m = limits::world_half_width_m;
  Command blow = carve(sphere({edge_m - 0.3F, 0.0F, 0.0F}, 2.0F), 24, 20.0F);
  std::get<CarveRequest>(blow.body).impact_m = {edge_m, 0.0F, 0.0F};
  auto delta = step({blow});
  EXPECT_EQ(delta->replies[0].refusal, "");
  ASSERT_GT(delta->spawned.size(), 4U);
  int64_t lost = 0;
  MassUnits dust = delta->ledger.dust;
  for (int tick = 0; tick < 120; ++tick) {
    delta = step();
    lost += count_of<DiscardOperation>(*delta);
    if (count_of<DiscardOperation>(*delta) > 0 && count_of<StampOperation>(*delta) == 0) {
      EXPECT_GT(delta->ledger.dust, dust) << "what left the world is dust";
    }
    dust = delta->ledger.dust;
  }
  EXPECT_GT(lost, 0);
  for (const PieceState& piece : delta->pieces)
    EXPECT_LE(std::abs(dequantise(piece.pose).position_m.x), edge_m + 1.0F);
}

TEST_F(OddInput, two_carves_in_one_tick_at_the_same_place) {
  const Shape ball = sphere({0.3F, -0.4F, 0.1F}, 1.5F);
  const Shape beside = sphere({0.7F, -0.4F, 0.1F}, 1.5F);
  const auto delta = step({carve(ball, 8, 6.0F, 1), carve(ball, 8, 6.0F, 2), carve(beside, 8, 6.0F, 3)});
  std::vector<Reply> replies = delta->replies;
  ASSERT_GE(replies.size(), 2U);
  EXPECT_EQ(replies[0].pieces, 8U);
  EXPECT_EQ(replies[1].pieces, 0U) << "the first carve left nothing";
  for (int tick = 0; tick < 300; ++tick) {
    const auto later = step();
    replies.insert(replies.end(), later->replies.begin(), later->replies.end());
  }
  EXPECT_EQ(replies.size(), 3U);
  for (const Reply& reply : replies) EXPECT_EQ(reply.refusal, "");
}

TEST_F(OddInput, limit_of_pieces_reached_between_two_carves) {
  start(world_for(20));
  const auto delta =
      step({carve(sphere({0.0F, -0.5F, 0.0F}, 2.0F), 16), carve(sphere({9.0F, -0.5F, 0.0F}, 2.0F), 16)});
  EXPECT_EQ(delta->replies[0].pieces, 16U);
  EXPECT_NE(delta->replies[1].refusal.find("pieces-max"), std::string::npos) << delta->replies[1].refusal;
  EXPECT_EQ(delta->pieces.size(), 16U);
  EXPECT_EQ(mass_of(delta->spawned) + delta->ledger.dust, delta->ledger.moved);
}

TEST_F(OddInput, a_carve_that_finds_no_room_is_told_what_would_help) {
  start(world_for(2000));
  const auto refusal = [&](uint32_t seeds) {
    return step({carve(sphere({40.0F, -0.5F, 0.0F}, 2.0F), seeds)})->replies[0].refusal;
  };
  const std::string never = refusal(limits::seeds_max);
  EXPECT_NE(never.find("ask for 2000 seeds at most"), std::string::npos) << never;
  EXPECT_NE(never.find("raised to 4096 (--pieces-max)"), std::string::npos) << never;
  start(world_for(20));
  step({carve(sphere({0.0F, -0.5F, 0.0F}, 2.0F), 16)});
  const std::string now = refusal(10);
  EXPECT_NE(now.find("wait until 6 have settled, ask for 4 seeds at most"), std::string::npos) << now;
  EXPECT_NE(now.find("raised to 26 (--pieces-max)"), std::string::npos) << now;
  EXPECT_NE(refusal(21).find("never fits"), std::string::npos);
  EXPECT_EQ(refusal(4), "");
}

/// A block that shatters on hard ground, again and again, in a world that has room for few of its pieces.
TEST_F(OddInput, limit_of_pieces_reached_in_mid_fracture) {
  WorldConfig config = world_for(7);
  config.methods.dents = false;  // they would take the room
  start(config);
  auto delta = step({fill(box({0.0F, 30.0F, 0.0F}, glm::vec3(2.0F))),
                     carve(box({0.0F, 30.0F, 0.0F}, glm::vec3(2.6F)), 3, 0.0F)});
  ASSERT_EQ(delta->pieces.size(), 3U);
  int64_t broke = 0;
  size_t most = 0;
  for (int tick = 0; tick < 400; ++tick) {
    delta = step();
    ASSERT_LE(delta->pieces.size(), 7U);
    most = std::max(most, delta->pieces.size());
    broke += count_of<ShatterOperation>(*delta);
  }
  EXPECT_GT(broke, 0);
  EXPECT_GE(most, 6U) << "the limit was never near";
}

/// Seeds that no scatter would give, straight to the cutter.
class OddSeeds : public ::testing::TestWithParam<std::pair<const char*, std::vector<glm::vec3>>> {};

TEST_P(OddSeeds, share_out_all_mass) {
  MapField field(flat_terrain);
  const Shape ball = in_voxels(sphere({0.0F, -0.5F, 0.0F}, 1.5F), 0.25F);
  const Window before = gather(field, band_box(ball));
  const Window solid = codes_of(ball, before.box);
  Window after = before;
  carve(after, solid);
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform}) {
    const Cut cut = cut_volume(cutter, extract(before, solid), before, after, GetParam().second);
    MassUnits shared = cut.dust;
    for (const CutPiece& piece : cut.pieces) {
      EXPECT_GE(piece.volume.mass, limits::piece_mass_min);
      shared += piece.volume.mass;
    }
    EXPECT_FALSE(cut.pieces.empty());
    EXPECT_EQ(shared, scree::mass_of(before) - scree::mass_of(after));
  }
}

std::vector<glm::vec3> on_a_plane() {
  std::vector<glm::vec3> seeds;
  for (int i = 0; i < 25; ++i) seeds.emplace_back(i % 5 - 2, -2.0F, i / 5 - 2);
  return seeds;
}

std::vector<glm::vec3> on_a_line() {
  std::vector<glm::vec3> seeds;
  for (int i = -4; i <= 4; ++i) seeds.emplace_back(i, -2.0F, 0.0F);
  return seeds;
}

INSTANTIATE_TEST_SUITE_P(
    odd_seeds, OddSeeds,
    ::testing::Values(
        std::pair("outside",
                  std::vector<glm::vec3>{{0.0F, -2.0F, 0.0F}, {60.0F, 9.0F, 0.0F}, {2.0F, 40.0F, 1.0F}}),
        std::pair("all_outside", std::vector<glm::vec3>{{50.0F, 0.0F, 0.0F}, {-50.0F, 3.0F, 1.0F}}),
        std::pair("duplicate",
                  std::vector<glm::vec3>{{1.0F, -2.0F, 0.0F}, {1.0F, -2.0F, 0.0F}, {-2.0F, -2.0F, 0.0F}}),
        std::pair("all_the_same", std::vector<glm::vec3>(12, glm::vec3(0.5F, -2.0F, 0.5F))),
        std::pair("coplanar", on_a_plane()), std::pair("collinear", on_a_line())),
    [](const auto& info) { return std::string(info.param.first); });

}  // namespace
}  // namespace scree
