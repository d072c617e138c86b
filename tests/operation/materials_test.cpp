// Terrain and pieces of several materials: what each operation makes of them, and the ledger of each.
#include "tests/support/materials.h"

#include <array>
#include <gtest/gtest.h>
#include <map>

#include "server/field/vdb_field.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "shared/operation/prepared_stamp.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/ledger_ground.h"

namespace scree {
namespace {

constexpr Material concrete{6}, brick{7}, glass{9};

/// A wall of brick, 1 m thick, with a lintel of concrete on it.
void build_wall(LedgerGround& ground) {
  ground.act(FillOperation{box({0.0F, 1.5F, 0.0F}, {2.0F, 1.5F, 0.5F}), brick});
  ground.act(FillOperation{box({0.0F, 3.5F, 0.0F}, {2.0F, 0.5F, 0.5F}), concrete});
}

TEST(materials, planes_of_any_number_of_values_are_what_they_were_made_of) {
  Random random(3);
  for (const uint32_t values : {1U, 2U, 3U, 4U, 5U, 16U, 17U, 256U}) {
    VoxelMaterials voxels;
    for (VoxelMaterial& voxel : voxels) voxel = static_cast<VoxelMaterial>(random.below(values));
    voxels[0] = 0;
    const BrickMaterials made(voxels);
    EXPECT_EQ(made.is_uniform(), values == 1);
    EXPECT_EQ(made.unpacked(), voxels);
    for (int i = 0; i < brick_voxels; ++i) ASSERT_EQ(made.at(i), voxels[static_cast<size_t>(i)]);
    EXPECT_EQ(made, BrickMaterials(voxels)) << "equal contents have equal forms";
    const size_t index_bytes = values == 1    ? 0
                               : values <= 2  ? 64
                               : values <= 4  ? 128
                               : values <= 16 ? 256
                                              : 512;
    EXPECT_LE(made.bytes(), index_bytes + 256 + 64);
    if (values > 1) {
      const uint64_t hash = brick_hash({1, 2, 3}, solid_brick(), made);
      voxels[17] = static_cast<VoxelMaterial>(voxels[17] ^ 1U);
      EXPECT_NE(brick_hash({1, 2, 3}, solid_brick(), BrickMaterials(voxels)), hash);
    }
  }
}

TEST(materials, a_fill_is_of_its_material_and_untouched_ground_says_nothing) {
  LedgerGround ground;
  build_wall(ground);
  EXPECT_EQ(ground.at({0.0F, 1.0F, 0.0F}), brick);
  EXPECT_EQ(ground.at({0.0F, 2.9F, 0.0F}), brick);
  EXPECT_EQ(ground.at({0.0F, 3.2F, 0.0F}), concrete);
  EXPECT_EQ(ground.at({0.0F, -0.5F, 0.0F}), material::soil);
  EXPECT_EQ(ground.at({0.0F, -1.5F, 0.0F}), material::rock);
  EXPECT_TRUE(ground.field.materials({0, -1, 0}).is_ground());
  EXPECT_GT(ground.materials.rows()[row_number(brick)].poured, 11 * 64 * 254);
  // What is poured as the ground's own costs no plane.
  LedgerGround plain;
  plain.act(FillOperation{box({0.0F, 2.0F, 0.0F}, {2.0F, 2.0F, 2.0F}), material::rock});
  plain.act(FillOperation{box({9.0F, 2.0F, 0.0F}, {2.0F, 2.0F, 2.0F})});
  for (const ChunkCoord chunk : plain.field.edited_chunks())
    for (const BrickCoord coord : plain.field.edited_bricks(chunk))
      EXPECT_TRUE(plain.field.materials(coord).is_ground());
}

TEST(materials, paint_changes_the_rock_in_a_shape_voxel_by_voxel_and_no_mass) {
  LedgerGround ground;
  build_wall(ground);
  const MassUnits before = ground.ledger.terrain;
  ground.act(PaintOperation{sphere({0.0F, 1.5F, 0.0F}, 0.8F), glass});
  EXPECT_EQ(ground.ledger.terrain, before);
  EXPECT_EQ(ground.at({0.0F, 1.5F, 0.0F}), glass);
  EXPECT_EQ(ground.at({0.5F, 1.5F, 0.25F}), glass);
  EXPECT_EQ(ground.at({1.0F, 1.5F, 0.0F}), brick) << "a voxel beyond";
  const auto& rows = ground.materials.rows();
  EXPECT_GT(rows[row_number(glass)].converted, 0);
  EXPECT_EQ(rows[row_number(glass)].converted, -rows[row_number(brick)].converted);
  EXPECT_EQ(rows[row_number(glass)].terrain, rows[row_number(glass)].converted);
}

TEST(materials, a_carve_gives_pieces_what_lay_where_they_were_cut) {
  for (const Cutter cutter : all_kinds<Cutter>) {
    LedgerGround ground;
    build_wall(ground);
    ground.act(carve_ball({0.0F, 3.0F, 0.0F}, 1.2F, 6, 1, cutter));
    ASSERT_GE(ground.pieces.size(), 2U);
    size_t mixed = 0;
    for (const auto& [id, volume] : ground.pieces) {
      mixed += volume->materials.is_uniform() ? 0 : 1;
      const VoxelBox& box = volume->window.box;
      for (int x = box.lo.x; x < box.hi.x; ++x)
        for (int y = box.lo.y; y < box.hi.y; ++y)
          for (int z = box.lo.z; z < box.hi.z; ++z)
            if (volume->window.at(x, y, z) < -22) {
              // Voxel 12 lies at 3 m, on the border.
              const Material is = volume->materials.at(VoxelCoord{x, y, z});
              EXPECT_TRUE(y == 12 || is == (y < 12 ? brick : concrete));
            }
    }
    EXPECT_GT(mixed, 0U) << name_of(cutter);
    EXPECT_TRUE(ground.field.materials({0, 1, 0}).is_uniform() == false)
        << "what is left keeps its materials";
  }
}

TEST(materials, a_broken_piece_shares_its_materials_out_to_the_unit) {
  LedgerGround ground;
  build_wall(ground);
  ground.act(carve_ball({0.0F, 3.0F, 0.0F}, 1.4F, 1, 1));
  ASSERT_TRUE(ground.pieces.contains(1));
  const MaterialMasses whole = masses_of(*ground.pieces.at(1));
  ASSERT_EQ(whole.size(), 2U);
  const glm::vec3 middle = ground.pieces.at(1)->centre_voxels;
  const Applied broken = ground.act(ShatterOperation{1, SeedPattern::radial, 7, 3, middle, 10});
  MaterialMasses sum;
  for (const CreatedPiece& piece : broken.created) add(sum, masses_of(*ground.pieces.at(piece.id)));
  MassUnits dust = broken.dust;
  for (const MaterialMass& one : whole) dust -= one.mass - mass_of(sum, one.material);
  EXPECT_EQ(dust, 0);
}

TEST(materials, every_method_of_merging_brings_the_materials_of_the_piece) {
  for (const StampMethod method : all_kinds<StampMethod>) {
    LedgerGround ground;
    build_wall(ground);
    ground.act(carve_ball({0.0F, 3.0F, 0.0F}, 1.0F, 1, 1));
    const auto volume = ground.pieces.at(1);
    const QuantisedPose pose = quantise({{8.0F, 1.2F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}});
    const PreparedStamp prepared = prepare_stamp(ground.field, ground.pieces, 1, pose, method, volume->mass);
    ground.act(prepared.operation);
    // The border between the two lay at 3 m, in a piece whose centre of volume went to 1.2 m.
    const float border_m = 1.2F + 3.0F - volume->centre_voxels.y * voxel_m;
    EXPECT_EQ(ground.at({8.0F, border_m - 0.5F, 0.0F}), brick) << name_of(method);
    EXPECT_EQ(ground.at({8.0F, border_m + 0.4F, 0.0F}), concrete) << name_of(method);
    EXPECT_EQ(ground.at({8.0F, -0.5F, 0.0F}), material::soil) << name_of(method);
  }
}

TEST(materials, an_island_takes_its_materials_along) {
  LedgerGround ground;
  ground.act(FillOperation{box({0.0F, 6.0F, 0.0F}, {1.0F, 0.5F, 0.5F}), brick});
  ground.act(FillOperation{box({0.0F, 6.9F, 0.0F}, {1.0F, 0.5F, 0.5F}), concrete});
  const MassUnits poured = ground.ledger.poured;
  ground.act(IslandOperation{{{-8, 18, -8}, {9, 34, 9}}, {0, 24, 0}, 1});
  ASSERT_TRUE(ground.pieces.contains(1));
  const MaterialMasses masses = masses_of(*ground.pieces.at(1));
  ASSERT_EQ(masses.size(), 2U);
  EXPECT_NEAR(static_cast<double>(mass_of(masses, brick)) / static_cast<double>(poured), 0.58, 0.05);
}

TEST(materials, recordings_of_before_play_as_they_were) {
  LedgerGround ground;
  ground.act(PaintOperation{box({8.0F, 0.0F, 0.0F}, {4.0F, 4.0F, 4.0F}), material::ice, true});
  EXPECT_EQ(ground.field.materials({4, 0, 0}), all_of(material::ice)) << "air of painted bricks, too";
  ground.act(carve_ball({0.0F, -0.5F, 0.0F}, 1.5F, 1, 1));
  StampOperation merge{1, quantise({{8.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}}), 0};
  merge.brings = Brings::nothing;
  ground.act(merge);
  EXPECT_EQ(ground.field.materials({4, 0, 0}), all_of(material::ice));
  ground.act(FillOperation{sphere({8.0F, 3.0F, 0.0F}, 1.0F)});
  EXPECT_EQ(ground.at({8.0F, 3.0F, 0.0F}), material::ice) << "what is poured takes the paint's material";
}

TEST(materials, little_is_converted_when_mixed_rubble_is_carved_and_merged_a_thousand_times) {
  LedgerGround ground;
  for (int i = 0; i < 6; ++i)
    ground.act(FillOperation{box({0.0F, 0.5F + static_cast<float>(i), 0.0F}, {3.0F, 0.5F, 3.0F}),
                             static_cast<Material>(6 + i)});
  Random random(9);
  PieceId next = 1;
  for (int cycle = 0; cycle < 1000; ++cycle) {
    const glm::vec3 at(random.unit() * 4.0F - 2.0F, random.unit() * 5.0F, random.unit() * 4.0F - 2.0F);
    ground.act(carve_ball(at, 0.6F + 0.5F * random.unit(), 3, next));
    next += 3;
    while (!ground.pieces.empty()) {
      const PieceId id = ground.pieces.begin()->first;
      const MassUnits mass = ground.pieces.at(id)->mass;
      PreparedStamp prepared = prepare_stamp(ground.field, ground.pieces, id, some_pose(at, random),
                                             StampMethod::facets, stamp_budget(mass, ground.ledger.dust));
      if (prepared.gain > mass + ground.ledger.dust)
        prepared =
            prepare_stamp(ground.field, ground.pieces, id, prepared.operation.pose, bounded_stamp, mass);
      ground.act(prepared.operation);
    }
    if (HasFailure()) return;
  }
  MassUnits converted = 0;
  for (const MaterialLedger::Row& row : ground.materials.rows())
    converted += std::max<MassUnits>(row.converted, 0);
  const double share = static_cast<double>(converted) / static_cast<double>(ground.ledger.moved);
  RecordProperty("converted_share", std::to_string(share));
  EXPECT_LE(share, 0.003) << "by a fixed bound of a half it was 0.0034";
  std::printf("converted %.4f %% of what was moved\n", 100.0 * share);
}

TEST(materials, flows_that_need_more_dust_than_there_is_are_not_entered) {
  const std::vector<MaterialLedger::Row> rows{{-10, 4, 6, 0, 0}, {-5, 0, 5, 0, 0}};
  MaterialLedger ledger(rows);
  const MaterialFlow piece{.material = material::rock, .terrain = 0, .pieces = -4};
  MaterialFlow gain{.material = material::soil, .terrain = 16};
  EXPECT_FALSE(ledger.enter(std::array{piece, gain}));
  EXPECT_EQ(ledger.rows(), rows);
  gain.terrain = 15;
  EXPECT_TRUE(ledger.enter(std::array{piece, gain}));
  EXPECT_TRUE(ledger.agrees({.terrain = 0}));
}

TEST(materials, fields_of_every_kind_agree) {
  MapField map(flat_terrain);
  VdbField vdb(flat_terrain);
  Random random(11);
  PieceTable of_map, of_vdb;
  PieceId next = 1;
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 at(random.unit() * 8.0F, random.unit() * 4.0F, random.unit() * 8.0F);
    const auto any = static_cast<Material>(random.below(12));
    Operation operation = FillOperation{sphere(at, 1.0F), any};
    if (i % 4 == 1) operation = PaintOperation{sphere(at, 1.5F), any};
    if (i % 4 == 2) operation = carve_ball(at, 1.2F, 2, next);
    if (i % 4 == 3 && !of_map.empty()) {
      StampOperation merge{of_map.begin()->first, some_pose(at, random), 0};
      operation = merge;
    }
    if (i % 4 == 2) next += 2;
    apply(operation, map, of_map);
    apply(operation, vdb, of_vdb);
    ASSERT_EQ(map.hash(), vdb.hash()) << i;
  }
  for (const auto& [id, volume] : of_map) EXPECT_EQ(volume->masses, of_vdb.at(id)->masses);
}

}  // namespace
}  // namespace scree
