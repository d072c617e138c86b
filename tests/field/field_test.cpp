// The field's storage: bricks, windows, hashes, generated and edited terrain.
#include "shared/field/field.h"

#include <gtest/gtest.h>
#include <type_traits>

#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/field/mass.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

Brick random_brick(Random& random) {
  Brick brick;
  for (Code& code : brick.codes) code = static_cast<Code>(static_cast<int>(random.below(255)) - 127);
  return brick;
}

TEST(field, codes_round_to_the_nearest_and_saturate) {
  EXPECT_EQ(encode(0.0F), 0);
  EXPECT_EQ(encode(3.0F), 127);
  EXPECT_EQ(encode(100.0F), 127);
  EXPECT_EQ(encode(-100.0F), -127);
  for (int code = -127; code <= 127; ++code) EXPECT_EQ(encode(decode(static_cast<Code>(code))), code);
}

TEST(field, occupancy_ramps_over_one_voxel_across_the_surface) {
  EXPECT_EQ(occupancy(code_solid), units_per_voxel);
  EXPECT_EQ(occupancy(code_air), 0);
  EXPECT_EQ(occupancy(0), units_per_voxel / 2);
  EXPECT_EQ(occupancy(encode(0.5F)), 1);
  EXPECT_EQ(occupancy(encode(0.53F)), 0);
}

TEST(field, unedited_terrain_reads_as_generated_and_hashes_to_zero) {
  MapField field(flat_terrain);
  EXPECT_EQ(field.brick({0, 5, 0}), air_brick());
  EXPECT_EQ(field.brick({0, -5, 0}), solid_brick());
  EXPECT_EQ(field.hash(), 0U);
  EXPECT_FALSE(field.is_edited({0, 5, 0}));
}

TEST(field, hash_is_the_sum_over_edited_bricks_whatever_their_order) {
  Random random(7);
  const Brick a = random_brick(random), b = random_brick(random);
  MapField one(flat_terrain), other(flat_terrain);
  one.set_brick({0, 0, 0}, a);
  one.set_brick({-9, 3, 4}, b);
  other.set_brick({-9, 3, 4}, a);
  other.set_brick({0, 0, 0}, a);
  other.set_brick({-9, 3, 4}, b);
  EXPECT_EQ(one.hash(), other.hash());
  EXPECT_EQ(one.hash(), brick_hash({0, 0, 0}, a) + brick_hash({-9, 3, 4}, b));
  EXPECT_EQ(one.chunk_hash(chunk_of(BrickCoord{0, 0, 0})), brick_hash({0, 0, 0}, a));
  EXPECT_NE(brick_hash({0, 0, 0}, a), brick_hash({0, 0, 1}, a));
}

/// By hand from the definition, in 64 bits: results depend on these values, so a narrower size_t must not.
TEST(field, coordinates_mix_to_the_same_64_bits_whatever_the_width_of_size_t) {
  static_assert(std::is_same_v<decltype(mixed_bits(BrickCoord{})), uint64_t>);
  EXPECT_EQ(mixed_bits(VoxelCoord{1, 2, 3}), 0x0EAA887059753FE1ULL);
  EXPECT_EQ(mixed_bits(BrickCoord{-5, 0, 70000}), 0x2FC301CF73E5F674ULL);
}

TEST(field, new_codes_of_a_painted_brick_hash_with_its_paint) {
  Random random(9);
  const Brick a = random_brick(random), b = random_brick(random);
  MapField field(flat_terrain);
  field.set_brick({1, 2, 3}, a);
  field.set_materials({1, 2, 3}, all_of(material::ice));
  field.set_brick({1, 2, 3}, b);
  EXPECT_EQ(field.hash(), brick_hash({1, 2, 3}, b, all_of(material::ice)));
  field.set_materials({1, 2, 3}, BrickMaterials());
  EXPECT_EQ(field.hash(), brick_hash({1, 2, 3}, b));
}

TEST(field, a_forgotten_chunk_reads_as_generated_again) {
  Random random(8);
  MapField field({TerrainKind::canyon, 3, 0.25F});
  const Brick before = field.brick({1, 1, 1});
  field.set_brick({1, 1, 1}, random_brick(random));
  field.set_brick({1, 2, 1}, solid_brick());
  EXPECT_EQ(field.edited_bricks({0, 0, 0}).size(), 2U);
  field.forget_chunk({0, 0, 0});
  EXPECT_EQ(field.brick({1, 1, 1}), before);
  EXPECT_EQ(field.hash(), 0U);
  EXPECT_TRUE(field.edited_chunks().empty());
}

TEST(field, scatter_writes_what_gather_read_and_reports_only_changes) {
  MapField field({TerrainKind::canyon, 3, 0.25F});
  const VoxelBox box{{-11, -3, 5}, {9, 17, 26}};
  Window window = gather(field, box);
  EXPECT_TRUE(scatter(field, window).empty());
  window.at(-11, -3, 5) = 55;
  window.at(8, 16, 25) = -55;
  const std::vector<BrickCoord> changed = scatter(field, window);
  ASSERT_EQ(changed.size(), 2U);
  EXPECT_EQ(changed[0], brick_of(VoxelCoord{-11, -3, 5}));
  EXPECT_EQ(changed[1], brick_of(VoxelCoord{8, 16, 25}));
  EXPECT_EQ(gather(field, box).codes, window.codes);
}

TEST(field, scatter_sees_a_change_of_any_single_code_whatever_the_window_cuts_off) {
  for (int begin = 0; begin < brick_size; ++begin)
    for (int end = begin + 1; end <= brick_size; ++end)
      for (int z = begin; z < end; ++z) {
        MapField field(flat_terrain);
        Window window = gather(field, {{2, 80, begin}, {4, 82, end}});
        window.at(3, 81, z) = 5;
        ASSERT_EQ(scatter(field, window).size(), 1U) << "code " << z << " of " << begin << " to " << end;
        ASSERT_EQ(gather(field, window.box).codes, window.codes);
      }
}

TEST(field, generated_chunks_are_kept_up_to_a_bound_and_made_anew_beyond) {
  Random random(9);
  MapField field({TerrainKind::canyon, 3, 0.25F});
  const Brick generated = field.brick({2, 0, 2}), edited = random_brick(random);
  field.set_brick({1, 0, 1}, edited);
  constexpr size_t bytes_max = size_t{1} << 20U;
  field.bound_generated(bytes_max);
  for (int i = 0; i < 5000; ++i) {
    field.brick({chunk_bricks * i, 400, 0});
    ASSERT_LE(field.generated_bytes(), bytes_max);
  }
  EXPECT_FALSE(field.has_generated({0, 0, 0}));
  EXPECT_EQ(field.brick({2, 0, 2}), generated);
  EXPECT_EQ(field.brick({1, 0, 1}), edited);
}

TEST(field, generated_chunks_that_are_used_stay_when_others_are_dropped) {
  MapField field(flat_terrain);
  field.bound_generated(size_t{1} << 20U);
  EXPECT_FALSE(field.touch_generated({0, -1, 0}));
  const Brick* const first = &field.generated_brick({0, -1, 0});
  const size_t bytes = field.generated_bytes();
  EXPECT_GT(bytes, sizeof(GeneratedChunk)) << "it has a surface";
  for (int i = 1; i < 5000; ++i) {
    field.generated_brick({chunk_bricks * i, 400, 0});
    ASSERT_TRUE(field.touch_generated({0, -1, 0}));
  }
  EXPECT_EQ(&field.generated_brick({0, -1, 0}), first);
  EXPECT_FALSE(field.has_generated({1, 100, 0}));
  EXPECT_EQ(field.generated_chunks(), (field.generated_bytes() - bytes) / sizeof(GeneratedChunk) + 1)
      << "chunks of air alone beside it";
}

TEST(field, sampling_a_plane_gives_its_distance_and_normal_across_brick_borders) {
  MapField field(flat_terrain);
  for (const float y : {-2.0F, -0.25F, 0.4F, 1.9F}) {
    const FieldSample s = sample(field, {7.5F, y, -0.5F});
    EXPECT_NEAR(s.distance_voxels, y, 0.02F);
    EXPECT_NEAR(s.gradient.y, 1.0F, 0.03F);
    EXPECT_NEAR(s.gradient.x, 0.0F, 1e-6F);
  }
}

TEST(field, tracing_down_meets_the_ground) {
  MapField field(flat_terrain);
  const std::optional<float> hit = trace(field, {3.0F, 40.0F, 3.0F}, {0.0F, -1.0F, 0.0F}, 100.0F);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(*hit, 40.0F, 0.1F);
  EXPECT_FALSE(trace(field, {3.0F, 40.0F, 3.0F}, {0.0F, 1.0F, 0.0F}, 100.0F).has_value());
}

}  // namespace
}  // namespace scree
