// What becomes of the rock of regions that count: exact to the unit, in a world.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "server/formats/world_codec.h"
#include "server/provenance/provenance.h"
#include "server/world/world_snapshot.h"
#include "tests/regions/some_regions.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

constexpr uint64_t red = 7, blue = 8;  // sessions

/// Two towers of two teams; and all other ground is a region, too, which is younger: so all that breaks is
/// counted, and the rows of all regions are the parts of the ledger.
class Towers : public PropWorld {
 public:
  explicit Towers(const WorldConfig& config = rock_world(), size_t threads = 1) : PropWorld(config, threads) {
    for (const float x : {-8.0F, 8.0F}) {
      EXPECT_EQ(ask(FillRequest{box({x, 3.5F, 0.0F}, {1.0F, 4.0F, 1.0F}), rock_or_ice(x)}).refusal, "");
    }
    steps(20);
    set("red tower", {-8.0F, 6.0F, 0.0F}, {3.0F, 5.5F, 3.0F});
    set("blue tower", {8.0F, 6.0F, 0.0F}, {3.0F, 5.5F, 3.0F});
    set("ground", {0.0F, 0.0F, 0.0F}, {200.0F, 200.0F, 200.0F});
    start_ = last().ledger;
  }

  static Material rock_or_ice(float x) { return x < 0.0F ? material::rock : material::ice; }

  void set(const std::string& name, glm::vec3 at_m, glm::vec3 half_m) {
    SetRegionRequest set = set_box(at_m, half_m, 0, name);
    set.region.counts = true;
    ASSERT_EQ(ask(set).refusal, "");
    take();
  }

  /// What a session breaks.
  Reply ask_as(uint64_t session, const Request& request) {
    go({{session, 1, request}});
    return last().replies.empty() ? Reply() : last().replies.front();
  }

  /// A tick, after which all rows sum up to the ledger's parts.
  void go(const std::vector<Command>& commands = {}) {
    step(commands);
    take();
    RegionMass sum;
    for (const RegionMass& row : rows_) {
      ASSERT_EQ(row.error(), 0);
      for (const MassUnits part : {row.cut, row.pieces, row.dust, row.carried, row.back, row.away})
        ASSERT_GE(part, 0);
      sum.cut += row.cut;
      sum.pieces += row.pieces;
      sum.dust += row.dust;
      sum.carried += row.carried;
      sum.back += row.back + row.away;
    }
    const Ledger& now = last().ledger;
    ASSERT_EQ(sum.pieces, now.pieces - start_.pieces);
    ASSERT_EQ(sum.dust, now.dust - start_.dust);
    ASSERT_EQ(sum.carried, now.stored - start_.stored);
    ASSERT_EQ(sum.back - sum.cut, now.terrain - start_.terrain);
  }
  void go_on(int ticks) {
    for (int i = 0; i < ticks && !testing::Test::HasFatalFailure(); ++i) go();
  }

  RegionId id_of(const std::string& name) {
    const std::vector<Region> regions = world().moment().regions;
    const auto region = std::ranges::find(regions, name, &Region::name);
    EXPECT_NE(region, regions.end()) << name;
    return region == regions.end() ? 0 : region->id;
  }
  /// What a region lost, of all materials, by all who broke it.
  RegionMass sum_of_region(const std::string& name) {
    RegionMass sum;
    const RegionId id = id_of(name);
    for (const RegionMass& row : rows_) {
      if (row.origin.region != id) continue;
      sum.cut += row.cut;
      sum.pieces += row.pieces;
      sum.carried += row.carried;
      sum.back += row.back;
      sum.away += row.away;
    }
    return sum;
  }
  const std::vector<RegionMass>& rows() const { return rows_; }

 private:
  void take() {
    if (last().region_masses != nullptr) rows_ = *last().region_masses;
  }

  std::vector<RegionMass> rows_;
  Ledger start_;
};

/// Both towers come down, each by the other team.
void bring_down(Towers& world) {
  for (int i = 0; i < 6; ++i) {
    const float z = static_cast<float>(i % 3 - 1);
    world.go({{blue, 1, carve_ball({-8.0F, 0.9F, z}, 1.2F, 5, static_cast<uint32_t>(i))},
              {red, 1, carve_ball({8.0F, 0.9F, z}, 1.2F, 5, static_cast<uint32_t>(i))}});
    world.go_on(4);
  }
  world.go_on(500);
}

TEST(RegionMass, two_towers_come_down_and_all_rows_are_the_ledgers_parts_at_every_tick) {
  Towers world;
  bring_down(world);
  ASSERT_FALSE(testing::Test::HasFatalFailure());
  for (const auto& [name, who] : {std::pair("red tower", blue), std::pair("blue tower", red)}) {
    const RegionMass sum = world.sum_of_region(name);
    EXPECT_GT(sum.cut, MassUnits{254} * 64 * 8) << name << " came down";
    EXPECT_GT(sum.back + sum.away, sum.cut / 20) << name << " lies there as rubble, in part";
    MassUnits by_other = 0;
    for (const RegionMass& row : world.rows())
      if (row.origin.region == world.id_of(name) && row.origin.party == who) by_other += row.cut;
    EXPECT_GT(by_other, sum.cut / 2) << name << " was broken by the other team";
  }
}

TEST(RegionMass, heaps_are_mixed_dug_and_carried_and_stay_to_the_unit) {
  Towers world;
  bring_down(world);
  ASSERT_FALSE(testing::Test::HasFatalFailure());
  const StoreName reds = named_store("red"), blues = named_store("blue");
  const MassUnits cut = world.sum_of_region("red tower").cut;
  for (const float x : {-10.0F, -8.0F, -6.0F, 6.0F, 8.0F, 10.0F}) {
    DigRequest dig{sphere({x, 0.7F, 0.0F}, 1.4F)};
    dig.store = x < 0.0F ? reds : blues;
    ASSERT_EQ(world.ask_as(blue, dig).refusal, "");
  }
  EXPECT_GT(world.sum_of_region("red tower").carried, 0);
  EXPECT_GT(world.sum_of_region("blue tower").carried, 0);
  // Mixed in one store, and placed where neither came from.
  world.go({{0, 1, TransferRequest{blues, reds}}});
  world.go({{0, 1, TransferRequest{reds, worlds_store(), material::rock, 254 * 20}}});
  const MassUnits carried = world.sum_of_region("red tower").carried;
  for (const Material one : {material::rock, material::ice})
    ASSERT_EQ(world.ask_as(0, PlaceRequest{sphere({0.0F, 1.0F, 20.0F}, 1.0F), one, false, reds}).refusal, "");
  EXPECT_LT(world.sum_of_region("red tower").carried, carried);
  EXPECT_GT(world.sum_of_region("red tower").away, 0);
  world.go_on(100);
  // Dug up again, it is known still.
  const MassUnits away = world.sum_of_region("red tower").away;
  DigRequest again{sphere({0.0F, 1.0F, 20.0F}, 1.5F)};
  again.store = blues;
  ASSERT_EQ(world.ask_as(red, again).refusal, "");
  EXPECT_LT(world.sum_of_region("red tower").away, away);
  EXPECT_GE(world.sum_of_region("red tower").cut, cut);
}

TEST(RegionMass, is_kept_with_the_world_and_goes_on_bit_for_bit) {
  Towers world;
  bring_down(world);
  ASSERT_FALSE(testing::Test::HasFatalFailure());
  ASSERT_EQ(world.ask_as(blue, DigRequest{sphere({-8.0F, 0.7F, 0.0F}, 1.4F), 0, named_store("red")}).refusal,
            "");
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<uint64_t> hashes;
  for (int time = 0; time < 2; ++time) {
    auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    EXPECT_FALSE(value->moment.provenance.empty());
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    EXPECT_EQ(*(*restored)->keyframe().region_masses, world.rows());
    for (int i = 0; i < 100; ++i) {
      std::vector<Command> commands;
      if (i == 0) commands.push_back({red, 1, carve_ball({-8.0F, 0.0F, 0.0F}, 2.0F)});
      hashes.push_back((*restored)->step(commands)->state_hash);
    }
    // More at a place than there is, is refused.
    for (PlacedMass& placed : value->moment.provenance) {
      if (!std::holds_alternative<StorePlace>(placed.place.at)) continue;
      placed.share.mass += 1 << 20;
      EXPECT_FALSE(World::restore(*value));
      break;
    }
  }
  EXPECT_TRUE(std::equal(hashes.begin(), hashes.begin() + 100, hashes.begin() + 100));
}

TEST(RegionMass, is_the_same_on_any_number_of_threads) {
  std::array<uint64_t, 2> hashes{};
  for (size_t i = 0; i < hashes.size(); ++i) {
    Towers world(rock_world(), 1 + i);
    bring_down(world);
    hashes[i] = world.last().state_hash;
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(RegionMass, follows_a_region_that_moves_and_is_forgotten_with_it) {
  Towers world;
  bring_down(world);
  ASSERT_FALSE(testing::Test::HasFatalFailure());
  const RegionMass before = world.sum_of_region("red tower");
  EXPECT_GT(before.back, 0);
  // It moves away: what lay in it lies elsewhere.
  world.set("red tower", {-8.0F, 60.0F, 0.0F}, {3.0F, 5.5F, 3.0F});
  EXPECT_EQ(world.sum_of_region("red tower").back, 0);
  EXPECT_EQ(world.sum_of_region("red tower").away, before.back + before.away);
  EXPECT_EQ(world.sum_of_region("red tower").cut, before.cut);
  world.go_on(5);
  world.set("red tower", {-8.0F, 6.0F, 0.0F}, {3.0F, 5.5F, 3.0F});
  const RegionMass after = world.sum_of_region("red tower");
  EXPECT_NEAR(static_cast<double>(after.back), static_cast<double>(before.back),
              0.3 * static_cast<double>(before.back))
      << "what lay beside it in the same bricks was mixed with it";
  const RegionId red_tower = world.id_of("red tower");
  ASSERT_EQ(world.ask(RemoveRegionRequest{"red tower"}).refusal, "");
  ASSERT_NE(world.last().region_masses, nullptr);
  EXPECT_FALSE(world.last().region_masses->empty()) << "the others' are counted still";
  for (const RegionMass& row : *world.last().region_masses) EXPECT_NE(row.origin.region, red_tower);
  for (const std::string name : {"blue tower", "ground"})
    ASSERT_EQ(world.ask(RemoveRegionRequest{name}).refusal, "");
  EXPECT_TRUE(world.last().region_masses->empty());
  EXPECT_TRUE(world.world().snapshot().moment.provenance.empty());
}

/// The rows' sum of one member.
MassUnits sum_of_rows(const PropWorld& world, MassUnits RegionMass::*member) {
  MassUnits sum = 0;
  for (const RegionMass& row : const_cast<PropWorld&>(world).world().region_masses()) sum += row.*member;
  return sum;
}

TEST(RegionMass, rock_from_elsewhere_is_not_the_regions_however_it_moves_there) {
  PropWorld world(rock_world());
  SetRegionRequest set = set_box(glm::vec3(0.0F), glm::vec3(10.0F), 0);
  set.region.counts = true;
  ASSERT_EQ(world.ask(set).refusal, "");
  ASSERT_EQ(world.ask(DigRequest{sphere({60.0F, -4.0F, 0.0F}, 3.0F), 0, worlds_store()}).refusal, "");
  // Rubble that slides, and rock in the air that falls and merges.
  ASSERT_EQ(world
                .ask(PlaceRequest{box({0.0F, 1.9F, -6.0F}, {0.5F, 2.0F, 0.5F}), material::rock, false,
                                  worlds_store()})
                .refusal,
            "");
  ASSERT_EQ(
      world.ask(PlaceRequest{box({6.0F, 6.0F, 6.0F}, glm::vec3(0.7F)), material::rock, true, worlds_store()})
          .refusal,
      "");
  world.steps(400);
  EXPECT_TRUE(world.last().pieces.empty());
  // What lay there before may have gone a little, where the block struck it.
  EXPECT_LT(sum_of_rows(world, &RegionMass::cut), 254 * 20);
  // Dug up again, it is still not the region's.
  ASSERT_EQ(
      world.ask(DigRequest{box({0.0F, 1.6F, -6.0F}, {1.5F, 1.2F, 1.5F}), 0, named_store("red")}).refusal, "");
  EXPECT_LT(sum_of_rows(world, &RegionMass::cut), 254 * 20);
}

TEST(RegionMass, paint_cuts_nothing_and_fills_are_the_regions_own) {
  PropWorld world(rock_world());
  SetRegionRequest set = set_box(glm::vec3(0.0F), glm::vec3(10.0F), 0);
  set.region.counts = true;
  ASSERT_EQ(world.ask(set).refusal, "");
  ASSERT_EQ(world.ask(FillRequest{box({0.0F, 1.0F, 0.0F}, glm::vec3(1.0F))}).refusal, "");
  ASSERT_EQ(world.ask(PaintRequest{sphere({0.0F, 1.0F, 0.0F}, 2.0F), material::ice}).refusal, "");
  EXPECT_EQ(sum_of_rows(world, &RegionMass::cut), 0);
  ASSERT_EQ(world.ask(DigRequest{box({0.0F, 1.5F, 0.0F}, glm::vec3(2.0F)), 0, worlds_store()}).refusal, "");
  EXPECT_EQ(sum_of_rows(world, &RegionMass::cut), world.last().ledger.stored);
  // Rubble of the region's own rock that was painted is the region's still.
  ASSERT_EQ(world
                .ask(PlaceRequest{box({0.0F, 0.0F, 0.0F}, {0.8F, 0.5F, 0.8F}), material::ice, false,
                                  worlds_store()})
                .refusal,
            "");
  const MassUnits back = sum_of_rows(world, &RegionMass::back);
  EXPECT_GT(back, 0);
  ASSERT_EQ(world.ask(PaintRequest{sphere({0.0F, 0.0F, 0.0F}, 2.5F), material::rock}).refusal, "");
  EXPECT_EQ(sum_of_rows(world, &RegionMass::back), back);
}

TEST(RegionMass, adds_up_under_blasts_with_every_method_of_merging) {
  for (const Recombination method : all_kinds<Recombination>) {
    WorldConfig config = flat_world();
    config.methods.recombine = method;
    PropWorld world(config);
    SetRegionRequest set = set_box({40.0F, 0.0F, 0.0F}, glm::vec3(10.0F), 0);
    set.region.counts = true;
    ASSERT_EQ(world.ask(set).refusal, "");
    ASSERT_EQ(world.ask(BlastRequest{{40.0F, 0.0F, 0.0F}, 4e6F, 1}).refusal, "");
    world.steps(200);
    EXPECT_GT(sum_of_rows(world, &RegionMass::cut), 0) << name_of(method);
  }
}

TEST(RegionMass, counts_nothing_where_no_region_asks_for_it) {
  PropWorld world(rock_world());
  ASSERT_EQ(world.ask(set_box({0.0F, 0.0F, 0.0F}, glm::vec3(9.0F), 0)).refusal, "");
  ASSERT_EQ(world.ask(carve_ball({0.0F, 0.0F, 0.0F}, 2.0F)).refusal, "");
  EXPECT_EQ(world.last().region_masses, nullptr);
}

TEST(RegionMass, what_is_cut_in_one_region_is_not_the_neighbours) {
  PropWorld world(rock_world());
  SetRegionRequest left = set_box({-19.875F, 0.0F, 0.0F}, glm::vec3(20.0F), 0, "left");
  SetRegionRequest right = set_box({20.125F, 0.0F, 0.0F}, glm::vec3(20.0F), 0, "right");
  left.region.counts = right.region.counts = true;
  ASSERT_EQ(world.ask(left).refusal, "");
  ASSERT_EQ(world.ask(right).refusal, "");
  const std::vector<Region> regions = world.world().moment().regions;
  // Half of it on either side; the border runs between voxels.
  ASSERT_EQ(world.ask(carve_ball({0.125F, 0.0F, 0.0F}, 2.0F, 40)).refusal, "");
  std::map<RegionId, MassUnits> cut;
  for (const RegionMass& row : *world.last().region_masses) cut[row.origin.region] += row.cut;
  const auto half = static_cast<double>(cut[regions[0].id]);
  EXPECT_NEAR(half, static_cast<double>(cut[regions[1].id]), 0.1 * half);
  // A piece that lay on one side alone is of it alone, but for what its neighbours' rounding gave.
  std::map<PieceId, std::map<RegionId, MassUnits>> of_pieces;
  for (const PlacedMass& placed : world.world().moment().provenance)
    if (const auto* piece = std::get_if<PiecePlace>(&placed.place.at))
      of_pieces[piece->piece][placed.share.origin.region] += placed.share.mass;
  size_t clear = 0;
  for (const PieceState& piece : world.last().pieces) {
    const float x_m = dequantise(piece.pose).position_m.x;
    if (std::abs(x_m) < 1.0F) continue;
    auto& of = of_pieces[piece.id];
    const auto own = static_cast<double>(of[regions[x_m < 0.0F ? 0 : 1].id]);
    const auto other = static_cast<double>(of[regions[x_m < 0.0F ? 1 : 0].id]);
    EXPECT_GT(own, 9.0 * other) << x_m;
    ++clear;
  }
  EXPECT_GT(clear, 5U);
}

}  // namespace
}  // namespace scree
