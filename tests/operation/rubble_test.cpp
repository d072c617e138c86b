// Rubble: what merges make of rock, and what cuts make of rubble. Mass is the same on each way, to the unit.
#include "shared/material/rubble.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <numeric>

#include "content/builtin_palette.h"
#include "shared/base/random.h"
#include "shared/operation/prepared_stamp.h"
#include "tests/support/ledger_ground.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

TerrainSource rubble_terrain() {
  return terrain_of_worlds(rock_terrain);
}

Material rubble_of(Material stones) {
  return rubble_terrain().rubble->rubble[row_number(stones)];
}

struct RubbleGround : LedgerGround {
  RubbleGround() : LedgerGround(rubble_terrain()) {}

  /// Merges a piece by a method; returns the terrain's gain.
  MassUnits merge(PieceId id, const QuantisedPose& pose, StampMethod method) {
    const MassUnits mass = pieces.at(id)->mass;
    PreparedStamp prepared = prepare_stamp(field, pieces, id, pose, method, stamp_budget(mass, ledger.dust));
    if (prepared.gain > mass + ledger.dust)
      prepared = prepare_stamp(field, pieces, id, pose, bounded_stamp, mass);
    return act(prepared.operation).terrain_gain;
  }
  /// What is full in a box, in voxels, and the mass, in voxels of solid rock.
  std::pair<double, double> bulk_and_mass(const VoxelBox& box) {
    const Window codes = gather(field, box);
    const RockWindow rock = rock_of(gather_materials(field, box), field.rubble());
    return {static_cast<double>(mass_of(codes)) / units_per_voxel,
            static_cast<double>(mass_of(codes, rock.fills)) / units_per_voxel};
  }
};

TEST(rubble, each_solid_row_has_rubble_and_loose_ground_is_its_own) {
  const RubbleRows rows = rubble_rows(builtin_palette());
  for (size_t i = 0; i < builtin_palette().rows.size(); ++i) {
    const MaterialRow& row = builtin_palette().rows[i];
    const auto own = static_cast<Material>(i);
    SCOPED_TRACE(row.name);
    const bool changes = !row.rubble && !row.loose;
    EXPECT_EQ(rows.rubble[i] != own, changes);
    EXPECT_EQ(rows.stones[row_number(rows.rubble[i])], row.rubble ? row.rubble->of : own);
    EXPECT_EQ(rows.fill[i] == fill_solid, !row.rubble);
  }
}

TEST(rubble, a_stone_that_merges_takes_as_much_more_room_as_rubble_has_pores) {
  for (const StampMethod method : all_kinds<StampMethod>) {
    RubbleGround ground;
    ground.act(carve_ball({0.0F, -1.0F, 0.0F}, 1.2F, 8, 1));
    double stones = 0.0, gained = 0.0;
    const VoxelBox box{{20, -4, -40}, {60, 24, 40}};
    for (int i = 0; !ground.pieces.empty(); ++i) {
      const PieceId id = ground.pieces.begin()->first;
      stones += static_cast<double>(ground.pieces.at(id)->mass);
      const glm::vec3 at{8.0F + 2.5F * static_cast<float>(i % 2), 1.2F,
                         -6.0F + 3.0F * static_cast<float>(i / 2)};
      gained += static_cast<double>(ground.merge(id, quantise({at, {1.0F, 0.0F, 0.0F, 0.0F}}), method));
      EXPECT_EQ(ground.at(at), rubble_of(material::rock));
    }
    const auto [bulk, mass] = ground.bulk_and_mass(box);
    const double floor = 40.0 * 80.0 * 4.0 + 40.0 * 80.0 * 0.5;  // the surface lies in the voxels of y = 0
    std::printf("%s: gained %.4f of the mass, swell %.3f\n", std::string(name_of(method)).c_str(),
                gained / stones, (bulk - floor) / (mass - floor));
    EXPECT_NEAR(gained / stones, 1.0, method == StampMethod::slices ? 0.15 : 0.02) << name_of(method);
    EXPECT_NEAR((bulk - floor) / (mass - floor), 128.0 / 79.0, 0.05) << name_of(method);
    if (HasFailure()) break;
  }
}

/// A box of rock, cut out whole, merges on flat ground; how much of its mass finds room.
double gain_of_block(int side, Brings brings) {
  RubbleGround ground;
  const float half_m = 0.5F * static_cast<float>(side) * voxel_m;
  const Shape block = box({0.0F, 12.0F, 0.0F}, glm::vec3(half_m));
  ground.act(FillOperation{block, material::rock});
  CarveOperation cut = carve_ball({0.0F, 12.0F, 0.0F}, 1.0F, 1, 1);
  cut.shape = box({0.0F, 12.0F, 0.0F}, glm::vec3(half_m + 0.5F));
  ground.act(cut);
  const Volume& volume = *ground.pieces.at(1);
  const auto mass = static_cast<double>(volume.mass);
  const QuantisedPose pose = quantise({{0.0F, half_m, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}});
  return static_cast<double>(ground
                                 .act(prepare_stamp(ground.field, ground.pieces, 1, pose, StampMethod::facets,
                                                    stamp_budget(volume.mass, 0), brings)
                                          .operation)
                                 .terrain_gain) /
         mass;
}

TEST(rubble, finds_room_up_to_blocks_of_a_thousand_voxels_and_larger_ones_do_as_rock) {
  for (const int side : {3, 6, 10}) EXPECT_GT(gain_of_block(side, Brings::rubble), 0.99) << side;
  for (const int side : {16, 24}) {
    EXPECT_LT(gain_of_block(side, Brings::rubble), 0.95) << "as rubble it does not fit";
    EXPECT_GT(gain_of_block(side, Brings::materials), 0.99) << side;
  }
}

TEST(rubble, what_is_cut_out_of_it_is_stones_of_the_rock_again) {
  RubbleGround ground;
  const Material rubble = rubble_of(material::rock);
  ground.act(FillOperation{box({0.0F, 2.0F, 0.0F}, {3.0F, 2.0F, 3.0F}), rubble});
  const MassUnits poured = ground.ledger.poured;
  EXPECT_NEAR(static_cast<double>(poured) / units_per_voxel / (24.0 * 16.0 * 24.0), 79.0 / 128.0, 0.02);
  ground.act(carve_ball({0.0F, 2.0F, 0.0F}, 1.5F, 20, 1));
  ASSERT_GT(ground.pieces.size(), 10U);
  for (const auto& [id, volume] : ground.pieces)
    for (const MaterialMass& one : masses_of(*volume)) EXPECT_EQ(one.material, material::rock);
  for (size_t row = 0; row < ground.materials.rows().size(); ++row)
    EXPECT_EQ(ground.materials.rows()[row].converted, 0) << "rubble counts as its stones";
}

TEST(rubble, paint_changes_no_mass) {
  RubbleGround ground;
  ground.act(FillOperation{box({0.0F, 2.0F, 0.0F}, {2.0F, 2.0F, 2.0F}), rubble_of(material::rock)});
  const Ledger before = ground.ledger;
  const Material brick = *builtin_palette().named("brick");
  ground.act(PaintOperation{sphere({0.0F, 0.5F, 0.0F}, 2.0F), brick});
  EXPECT_EQ(ground.at({0.0F, 1.0F, 0.0F}), rubble_of(brick));
  EXPECT_EQ(ground.at({0.0F, -1.0F, 0.0F}), brick);
  EXPECT_TRUE(ground.ledger == before);
}

TEST(rubble, a_thousand_carves_and_merges_keep_the_mass_and_little_dust) {
  RubbleGround ground;
  Random random(3);
  PieceId next = 1;
  for (int cycle = 0; cycle < 200; ++cycle) {
    const glm::vec3 at(random.unit() * 4.0F - 2.0F, random.unit() * 1.5F - 1.0F, random.unit() * 4.0F - 2.0F);
    ground.act(carve_ball(at, 0.6F + 0.5F * random.unit(), 5, next));
    next += 5;
    while (!ground.pieces.empty()) {
      const PieceId id = ground.pieces.begin()->first;
      ground.merge(id, some_pose(at, random), StampMethod::facets);
    }
    if (HasFailure()) return;
  }
  std::printf("dust %.4f of what was moved\n",
              static_cast<double>(ground.ledger.dust) / static_cast<double>(ground.ledger.moved));
}

}  // namespace
}  // namespace scree
