// Operations on a field: what a carve takes out is what its pieces weigh; what a stamp adds is what was
// planned.
#include "shared/operation/operation.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "shared/base/limits.h"
#include "shared/recombine/stamp.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

MassUnits mass_in(Field& field, const VoxelBox& box) {
  MassUnits sum = 0;
  for (const Code code : gather(field, box).codes) sum += occupancy(code);
  return sum;
}

MassUnits mass_of(const PieceTable& pieces) {
  MassUnits sum = 0;
  for (const auto& [id, volume] : pieces) sum += volume->mass;
  return sum;
}

CarveOperation ball(uint32_t seeds, SeedPattern pattern = SeedPattern::uniform) {
  return {sphere({0.3F, -0.4F, 0.1F}, 2.0F), pattern, seeds, 42, {0.3F, 0.0F, 0.1F}, 1};
}

TEST(operation, a_carve_takes_out_exactly_what_its_pieces_weigh) {
  for (const SeedPattern pattern : {SeedPattern::uniform, SeedPattern::radial})
    for (const uint32_t seeds : {1U, 7U, 64U, 500U}) {
      MapField field(flat_terrain);
      PieceTable pieces;
      const VoxelBox box = band_box(in_voxels(ball(1).shape, voxel_m));
      const MassUnits before = mass_in(field, box);
      const Applied applied = apply(ball(seeds, pattern), field, pieces);
      EXPECT_EQ(mass_in(field, box) - before, applied.terrain_gain);
      EXPECT_EQ(mass_of(pieces) + applied.dust, -applied.terrain_gain);
      EXPECT_EQ(pieces.size(), applied.created.size());
      EXPECT_GE(pieces.size(), std::min(seeds, 64U) * 9 / 10);
      for (const auto& [id, volume] : pieces) EXPECT_GE(volume->mass, limits::piece_mass_min);
    }
}

TEST(operation, a_crater_takes_out_exactly_what_its_pieces_weigh) {
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform})
    for (const float radius_m : {0.5F, 1.3F, 2.5F}) {
      MapField field({TerrainKind::canyon, 2, voxel_m});
      PieceTable pieces;
      CarveOperation op = ball(30, SeedPattern::radial);
      op.shape = crater({0.3F, ground_height_m(field.source(), 0.3F, 0.1F) - 0.3F, 0.1F}, radius_m);
      op.cutter = cutter;
      ASSERT_TRUE(validate(op, pieces, voxel_m).has_value());
      const VoxelBox box = band_box(in_voxels(op.shape, voxel_m));
      const MassUnits before = mass_in(field, box);
      const Applied applied = apply(op, field, pieces);
      EXPECT_LT(applied.terrain_gain, 0);
      EXPECT_EQ(mass_in(field, box) - before, applied.terrain_gain);
      EXPECT_EQ(mass_of(pieces) + applied.dust, -applied.terrain_gain);
    }
}

TEST(operation, every_cutter_and_pattern_conserves_mass) {
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform})
    for (const SeedPattern pattern : all_kinds<SeedPattern>) {
      MapField field(flat_terrain);
      PieceTable pieces;
      CarveOperation op = ball(4, pattern);
      op.cutter = cutter;
      // Two inside, one a hair beside the first, one in the air.
      if (!is_drawn(pattern))
        op.authored_m = {{0.3F, -0.5F, 0.1F}, {0.31F, -0.5F, 0.1F}, {0.3F, 9.0F, 0.1F}, {-0.8F, -0.9F, 0.1F}};
      ASSERT_TRUE(validate(op, pieces, voxel_m).has_value());
      const Applied applied = apply(op, field, pieces);
      EXPECT_EQ(pieces.size(), is_drawn(pattern) ? 4U : 2U);
      EXPECT_EQ(mass_of(pieces) + applied.dust, -applied.terrain_gain);
      const MassUnits before = mass_of(pieces);
      const PieceId first = pieces.begin()->first;
      const Applied broken =
          apply(ShatterOperation{first, SeedPattern::clustered, 3, 1, {}, 50, cutter}, field, pieces);
      EXPECT_EQ(broken.created.size(), 3U);
      EXPECT_EQ(mass_of(pieces) + broken.dust, before);
    }
}

TEST(operation, a_natural_break_turns_its_finest_into_dust_by_every_cutter) {
  for (const Cutter cutter : all_kinds<Cutter>) {
    MapField field(flat_terrain);
    PieceTable pieces;
    CarveOperation op = ball(60, SeedPattern::natural);
    op.cutter = cutter;
    const Applied applied = apply(op, field, pieces);
    EXPECT_LE(pieces.size(), 60U);
    EXPECT_GE(pieces.size(), 25U);
    EXPECT_EQ(mass_of(pieces) + applied.dust, -applied.terrain_gain);
    EXPECT_GT(applied.dust, -applied.terrain_gain / 50);
    EXPECT_LT(applied.dust, -applied.terrain_gain / 12);
    MassUnits left = 0;
    for (const MaterialFlow& flow : applied.flows) left -= flow.terrain + flow.pieces;
    EXPECT_EQ(left, applied.dust) << "by material";
    for (const auto& [id, volume] : pieces) EXPECT_GE(volume->mass, limits::piece_mass_min);
  }
}

TEST(operation, authored_seeds_outside_of_the_volume_leave_it_whole) {
  MapField field(flat_terrain);
  PieceTable pieces;
  CarveOperation op = ball(2, SeedPattern::authored);
  op.authored_m = {{0.3F, 9.0F, 0.1F}, {80.0F, 0.0F, 0.0F}};
  const Applied applied = apply(op, field, pieces);
  EXPECT_EQ(pieces.size(), 1U);
  EXPECT_EQ(mass_of(pieces), -applied.terrain_gain);
}

TEST(operation, a_carve_of_air_makes_nothing) {
  MapField field(flat_terrain);
  PieceTable pieces;
  CarveOperation op = ball(16);
  op.shape = sphere({0.0F, 20.0F, 0.0F}, 2.0F);
  const Applied applied = apply(op, field, pieces);
  EXPECT_TRUE(applied.changed.empty());
  EXPECT_TRUE(pieces.empty());
  EXPECT_EQ(applied.dust, 0);
}

TEST(operation, pieces_are_the_same_solid_as_the_volume_that_they_came_from) {
  MapField field(flat_terrain);
  PieceTable pieces;
  const CarveOperation op = ball(64);
  const Shape shape = in_voxels(op.shape, voxel_m);
  const Window before = gather(field, band_box(shape));
  apply(op, field, pieces);
  // Every voxel well inside the ball is inside exactly one piece, but for those on the cuts.
  int covered = 0, uncovered = 0, twice = 0;
  for (int x = before.box.lo.x; x < before.box.hi.x; ++x)
    for (int y = before.box.lo.y; y < before.box.hi.y; ++y)
      for (int z = before.box.lo.z; z < before.box.hi.z; ++z) {
        if (before.at(x, y, z) >= 0 || distance(shape, glm::vec3(x, y, z)) >= 0.0F) continue;
        int pieces_here = 0;
        for (const auto& [id, v] : pieces) {
          const VoxelBox& b = v->window.box;
          if (x < b.lo.x || y < b.lo.y || z < b.lo.z || x >= b.hi.x || y >= b.hi.y || z >= b.hi.z) continue;
          pieces_here += v->window.at(x, y, z) < 0 ? 1 : 0;
        }
        (pieces_here == 0 ? uncovered : pieces_here == 1 ? covered : twice) += 1;
      }
  EXPECT_LT(uncovered, covered / 20);
  EXPECT_LT(twice, covered / 20);
}

TEST(operation, a_stamp_gains_what_was_planned_and_stays_within_the_budget) {
  MapField field(flat_terrain);
  PieceTable pieces;
  apply(ball(40), field, pieces);
  const PieceTable made = pieces;
  for (const auto& [id, volume] : made) {
    StampOperation op{
        id,
        quantise({{static_cast<float>(id % 7) - 3.0F, 0.2F + 0.1F * static_cast<float>(id), 1.0F},
                  glm::normalize(glm::quat(1.0F, 0.1F * static_cast<float>(id), 0.3F, -0.2F))}),
        0};
    const Window window = gather(field, stamp_box(*volume, op.pose, voxel_m));
    const StampPlan plan = plan_stamp(op.method, window, *volume, op.pose, voxel_m, volume->mass);
    op.shift = plan.shift;
    const Applied applied = apply(op, field, pieces);
    EXPECT_EQ(applied.terrain_gain, plan.gain) << "piece " << id;
    EXPECT_LE(applied.terrain_gain, volume->mass);
    EXPECT_GT(applied.terrain_gain, volume->mass * 85 / 100) << "piece " << id;
  }
  EXPECT_TRUE(pieces.empty());
}

TEST(operation, an_apply_reads_and_writes_only_its_read_box) {
  MapField field({TerrainKind::canyon, 2, voxel_m});
  PieceTable pieces;
  const Operation op = ball(8);
  const VoxelBox box = read_box(op, pieces, voxel_m);
  for (const BrickCoord coord : apply(op, field, pieces).changed) {
    bool inside = false;
    for_each_brick(box, [&](BrickCoord b) { inside = inside || b == coord; });
    EXPECT_TRUE(inside);
  }
}

TEST(operation, two_fields_that_apply_the_same_operations_stay_equal) {
  MapField one({TerrainKind::canyon, 2, voxel_m}), other({TerrainKind::canyon, 2, voxel_m});
  PieceTable pieces_one, pieces_other;
  const std::vector<Operation> operations = {
      FillOperation{box({3.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F})},
      FillOperation{capsule({0.0F, 6.0F, 0.0F}, {8.0F, 7.0F, 2.0F}, 0.7F)},
      ball(32),
      StampOperation{3, quantise({{1.0F, 0.0F, 1.0F}, glm::quat(0.5F, 0.5F, 0.5F, 0.5F)}), 5},
      DiscardOperation{4},
      ShatterOperation{5, SeedPattern::uniform, 4, 7, {1.0F, 2.0F, 3.0F}, 900}};
  for (const Operation& op : operations) {
    const Applied a = apply(op, one, pieces_one);
    const Applied b = apply(op, other, pieces_other);
    EXPECT_EQ(a.changed, b.changed);
    EXPECT_EQ(a.terrain_gain, b.terrain_gain);
    EXPECT_EQ(a.created.size(), b.created.size());
    EXPECT_EQ(one.hash(), other.hash());
  }
  EXPECT_NE(one.hash(), 0U);
}

TEST(operation, a_piece_that_shatters_shares_out_its_mass_exactly) {
  MapField field(flat_terrain);
  PieceTable pieces;
  apply(ball(2), field, pieces);
  const uint64_t field_hash = field.hash();
  const PieceId parent = pieces.begin()->first;
  const std::shared_ptr<const Volume> volume = pieces.at(parent);
  const Applied applied =
      apply(ShatterOperation{parent, SeedPattern::radial, 6, 9, volume->centre_voxels, 100}, field, pieces);
  EXPECT_EQ(applied.created.size(), 6U);
  EXPECT_EQ(applied.terrain_gain, 0);
  EXPECT_TRUE(applied.changed.empty());
  EXPECT_EQ(field.hash(), field_hash);
  EXPECT_FALSE(pieces.contains(parent));
  MassUnits mass = applied.dust;
  glm::vec3 moment(0.0F);
  for (const CreatedPiece& child : applied.created) {
    mass += pieces.at(child.id)->mass;
    moment += pieces.at(child.id)->centre_voxels * static_cast<float>(pieces.at(child.id)->mass);
  }
  EXPECT_EQ(mass, volume->mass);
  EXPECT_LT(glm::distance(moment / static_cast<float>(mass), volume->centre_voxels), 0.2F);
}

TEST(operation, an_island_becomes_a_piece_of_the_mass_that_the_terrain_loses_and_a_speck_dust) {
  MapField field(flat_terrain);
  PieceTable pieces;
  const Applied poured = apply(FillOperation{sphere({0.0F, 5.0F, 0.0F}, 1.0F)}, field, pieces);
  const VoxelBox whole{{-4, 16, -4}, {5, 25, 5}};
  const Applied applied = apply(IslandOperation{whole, {0, 20, 0}, 5}, field, pieces);
  ASSERT_EQ(applied.created.size(), 1U);
  EXPECT_EQ(applied.terrain_gain, -poured.terrain_gain);
  EXPECT_EQ(pieces.at(5)->mass, poured.terrain_gain);
  const Applied speck = apply(FillOperation{sphere({0.0F, 5.0F, 0.0F}, 0.15F)}, field, pieces);
  const Applied swept = apply(IslandOperation{whole, {0, 20, 0}, 6}, field, pieces);
  EXPECT_TRUE(swept.created.empty());
  EXPECT_EQ(swept.dust, speck.terrain_gain);
  EXPECT_GT(swept.dust, 0);
}

TEST(operation, what_no_world_can_take_is_refused_by_name) {
  const PieceTable none;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const auto refused = [&](const Operation& op, const char* word) {
    const Result<void> result = validate(op, none, voxel_m);
    ASSERT_FALSE(result.has_value()) << word;
    EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
  };
  CarveOperation op = ball(8);
  const auto with = [&](Shape shape) {
    CarveOperation changed = op;
    changed.shape = shape;
    return changed;
  };
  refused(with(sphere({0, 0, 0}, nan)), "radius is not a finite");
  refused(with(sphere({0, 0, 0}, infinite)), "radius is not a finite");
  refused(with(sphere({0, 0, 0}, -1.0F)), "negative");
  refused(with(sphere({0, 0, 0}, 0.0F)), "zero");
  refused(with(sphere({0, 0, 0}, 9.0F)), "may be at most 8 m");
  refused(with(sphere({0, 0, 0}, 0.01F)), "must be at least 0.125 m");
  refused(with(sphere({1e6F, 0, 0}, 1.0F)), "outside the world");
  refused(with(sphere({nan, 0, 0}, 1.0F)), "position");
  refused(with({static_cast<ShapeKind>(9), {}, {}, 1.0F}), "kind");
  refused(with(box({0, 0, 0}, {1.0F, 0.0F, 1.0F})), "half extent");
  refused(FillOperation{capsule({0, 0, 0}, {50.0F, 0, 0}, 1.0F)}, "may be at most 8 m");
  op.seeds = 0;
  refused(op, "at least one seed");
  op.seeds = limits::seeds_max + 1;
  refused(op, "seeds are over the limit of 4096");
  op = ball(2, SeedPattern::authored);
  refused(op, "0 authored seeds for a carve of 2");
  op.authored_m = {{0.0F, 0.0F, 0.0F}, {0.0F, nan, 0.0F}};
  refused(op, "authored seed's position");
  op.authored_m[1] = {0.0F, 600.0F, 0.0F};
  refused(op, "authored seed is outside the world");
  op.authored_m.assign(limits::authored_seeds_max + 1, glm::vec3(0.0F));
  op.seeds = limits::authored_seeds_max + 1;
  refused(op, "limits.authored_seeds_max");
  op.pattern = SeedPattern::radial;
  refused(op, "257 authored seeds for a carve of 0");
  op = ball(8, static_cast<SeedPattern>(kind_count<SeedPattern>));
  refused(op, "pattern is not a known one (uniform, radial,");
  const auto no_material = static_cast<Material>(materials_max);
  refused(PaintOperation{sphere({0, 0, 0}, 1.0F), no_material}, "material 255 is over the last");
  const auto no_shape = static_cast<ShapeKind>(kind_count<ShapeKind>);
  refused(FillOperation{{no_shape, {}, {}, 1.0F}}, "kind of shape is not a known one (sphere, box");
  op = ball(8);
  op.cutter = static_cast<Cutter>(3);
  refused(op, "cutter");
  refused(StampOperation{77, {}, 0}, "no piece 77");
  refused(DiscardOperation{78}, "no piece 78");
  refused(ShatterOperation{79, SeedPattern::radial, 4, 0, {}, 100}, "no piece 79");
  const VoxelBox island{{0, 0, 0}, {8, 8, 8}};
  EXPECT_TRUE(validate(IslandOperation{island, {7, 0, 0}, 1}, none, voxel_m).has_value());
  refused(IslandOperation{island, {8, 0, 0}, 1}, "start is outside its box");
  refused(IslandOperation{{{0, 0, 0}, {0, 8, 8}}, {0, 0, 0}, 1}, "start is outside its box");
  refused(IslandOperation{{{0, 0, 0}, {8, 113, 8}}, {0, 0, 0}, 1}, "island_side_max_bricks");
  refused(IslandOperation{{{1 << 24, 0, 0}, {(1 << 24) + 8, 8, 8}}, {1 << 24, 0, 0}, 1}, "outside the world");
}

TEST(operation, ids_of_pieces_never_wrap_around) {
  PieceTable pieces;
  pieces[5] = std::make_shared<const Volume>();
  CarveOperation carve = ball(8);
  carve.first_piece = UINT32_MAX - 8;
  EXPECT_TRUE(validate(carve, pieces, voxel_m).has_value());
  ShatterOperation shatter{5, SeedPattern::radial, 8, 0, {}, UINT32_MAX - 8};
  EXPECT_TRUE(validate(shatter, pieces, voxel_m).has_value());
  IslandOperation island{{{0, 0, 0}, {8, 8, 8}}, {7, 0, 0}, UINT32_MAX - 1};
  EXPECT_TRUE(validate(island, pieces, voxel_m).has_value());
  carve.first_piece = shatter.first_piece = UINT32_MAX - 7;
  island.piece = UINT32_MAX;
  for (const Operation& operation : {Operation(carve), Operation(shatter), Operation(island)}) {
    const Result<void> valid = validate(operation, pieces, voxel_m);
    ASSERT_FALSE(valid.has_value());
    EXPECT_NE(valid.error().message.find("used up"), std::string::npos) << valid.error().message;
  }
}

TEST(pose, quantising_keeps_position_and_rotation_within_a_step) {
  const Pose pose{{12.345F, -3.21F, 1000.5F}, glm::normalize(glm::quat(0.3F, -0.8F, 0.2F, 0.4F))};
  const Pose back = dequantise(quantise(pose));
  EXPECT_NEAR(glm::distance(pose.position_m, back.position_m), 0.0F, 1e-3F);
  EXPECT_NEAR(std::abs(glm::dot(pose.rotation, back.rotation)), 1.0F, 1e-5F);
  EXPECT_EQ(quantise(back), quantise(pose));
}

TEST(pose, any_bits_are_a_unit_rotation) {
  for (const uint32_t bits : {0U, 0xFFFFFFFFU, 0x3FFFFFFFU, 0x80000000U, 0x12345678U}) {
    const glm::quat q = dequantise({0, 0, 0, bits}).rotation;
    EXPECT_NEAR(glm::dot(q, q), 1.0F, 1e-5F);
  }
}

}  // namespace
}  // namespace scree
