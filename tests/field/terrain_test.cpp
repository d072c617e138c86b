// Generated terrain: seamless, repeatable, a distance field.
#include "shared/field/terrain.h"

#include <cmath>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/field/field.h"
#include "shared/field/rough_noise.h"

namespace scree {
namespace {

const TerrainSource sources[] = {
    {TerrainKind::flat, 1, 0.25F}, {TerrainKind::noise, 5, 0.25F}, {TerrainKind::canyon, 9, 0.5F}};

TEST(terrain, one_voxel_steps_change_the_distance_by_at_most_one_voxel) {
  for (const TerrainSource& source : sources) {
    MapField field(source);
    const VoxelBox box{{-50, -60, -20}, {60, 60, 50}};
    const Window window = gather(field, box);
    int steepest = 0;
    for (int x = box.lo.x; x + 1 < box.hi.x; ++x)
      for (int y = box.lo.y; y + 1 < box.hi.y; ++y)
        for (int z = box.lo.z; z + 1 < box.hi.z; ++z) {
          const int here = window.at(x, y, z);
          steepest =
              std::max({steepest, std::abs(window.at(x + 1, y, z) - here),
                        std::abs(window.at(x, y + 1, z) - here), std::abs(window.at(x, y, z + 1) - here)});
        }
    // One voxel is 42.33 codes; each of two codes rounds by at most a half.
    EXPECT_LE(steepest, 43) << name_of(source.kind);
    EXPECT_GE(steepest, 35) << name_of(source.kind) << ": there should be a surface here";
  }
}

TEST(terrain, noise_has_overhangs_and_caves) {
  MapField field({TerrainKind::noise, 1, 0.25F});
  const VoxelBox box{{-128, -60, -128}, {128, 60, 128}};
  const Window window = gather(field, box);
  int columns_with_overhang = 0;
  for (int x = box.lo.x; x < box.hi.x; x += 2)
    for (int z = box.lo.z; z < box.hi.z; z += 2) {
      int crossings = 0;
      for (int y = box.lo.y; y + 1 < box.hi.y; ++y)
        crossings += (window.at(x, y, z) < 0) != (window.at(x, y + 1, z) < 0) ? 1 : 0;
      columns_with_overhang += crossings > 1 ? 1 : 0;
    }
  EXPECT_GT(columns_with_overhang, 100);
}

TEST(terrain, a_chunk_is_a_pure_function_of_source_and_place) {
  const TerrainSource source{TerrainKind::canyon, 4, 0.25F};
  const GeneratedChunk one = generate_chunk(source, {0, 0, 0});
  const GeneratedChunk other = generate_chunk(source, {0, 0, 0});
  for (size_t i = 0; i < one.bricks.size(); ++i) EXPECT_EQ(*one.bricks[i], *other.bricks[i]);
}

TEST(terrain, seeds_and_kinds_differ) {
  MapField a({TerrainKind::canyon, 1, 0.25F}), b({TerrainKind::canyon, 2, 0.25F});
  const VoxelBox box{{0, -32, 0}, {32, 32, 32}};
  EXPECT_NE(gather(a, box).codes, gather(b, box).codes);
}

TEST(terrain, ground_height_is_where_the_field_turns_solid) {
  const TerrainSource source{TerrainKind::canyon, 1, 0.25F};
  MapField field(source);
  for (const float x : {-20.0F, 3.0F, 30.0F}) {
    const float height = ground_height_m(source, x, 5.0F);
    EXPECT_LT(sample(field, glm::vec3(x, height - 0.5F, 5.0F) / 0.25F).distance_voxels, 0.5F);
    EXPECT_GT(sample(field, glm::vec3(x, height + 1.5F, 5.0F) / 0.25F).distance_voxels, 0.0F);
  }
}

TEST(terrain, noise_stays_within_the_range_told_for_a_box) {
  Random random(5);
  float share = 0.0F;
  for (int round = 0; round < 200; ++round) {
    const auto place = [&](float half) { return (random.unit() * 2.0F - 1.0F) * half; };
    const glm::vec3 lo(place(3000.0F), place(40.0F), place(3000.0F));
    const glm::vec3 size =
        glm::vec3(random.unit(), random.unit(), random.unit()) * (round % 2 == 0 ? 10.0F : 1.0F);
    const RoughRange range = rough_range(lo, lo + size, 7);
    for (int i = 0; i < 50; ++i) {
      const glm::vec3 p = lo + size * glm::vec3(random.unit(), random.unit(), random.unit());
      const float value = RoughColumn(p.x, p.y, 7).at(p.z);
      EXPECT_GE(value, range.least_m);
      EXPECT_LE(value, range.most_m);
    }
    share += (range.most_m - range.least_m) / (2.0F * amplitude_sum_m) / 200.0F;
  }
  EXPECT_LT(share, 0.9F) << "it tells more than the amplitudes do";
  EXPECT_GE(rough_range(glm::vec3(-500.0F), glm::vec3(500.0F), 7).most_m, amplitude_sum_m);
}

TEST(terrain, below_the_floor_of_a_column_of_chunks_there_is_only_rock) {
  for (const TerrainKind kind : {TerrainKind::noise, TerrainKind::canyon}) {
    const TerrainSource source{kind, 3, 0.25F};
    const float side_m = chunk_size * source.voxel_size_m;
    int higher = 0;
    for (int x = -6; x < 6; ++x)
      for (int z = -3; z < 3; ++z) {
        const float floor = floor_m(source, x, z);
        ASSERT_GE(floor, floor_m(source));
        higher += floor > floor_m(source) ? 1 : 0;
        Random random(static_cast<uint64_t>(x * 100 + z + 1000));
        for (int i = 0; i < 100; ++i) {
          const glm::vec3 p((static_cast<float>(x) + random.unit()) * side_m,
                            floor - random.unit() * random.unit() * 20.0F,
                            (static_cast<float>(z) + random.unit()) * side_m);
          ASSERT_LT(ground_density(source, p), 0.0F) << p.x << ' ' << p.y << ' ' << p.z;
        }
      }
    EXPECT_GT(higher, 10) << name_of(kind) << ": bounds of the noise tell more than the kind does";
  }
}

TEST(terrain, a_chunk_told_by_bounds_alone_is_what_the_ground_is_there) {
  const TerrainSource source{TerrainKind::canyon, 1, 0.25F};
  for (int x = -3; x < 5; ++x)
    for (int y = -2; y < 5; ++y)
      for (int z = -2; z < 2; ++z) {
        const GeneratedChunk chunk = generate_chunk(source, {x, y, z});
        for (int i = 0; i < 64; ++i) {
          const Brick* const uniform = uniform_equivalent(*chunk.bricks[static_cast<size_t>(i)]);
          if (uniform != &solid_brick()) continue;
          const VoxelCoord at = first_voxel(brick_in_chunk({x, y, z}, i)) + VoxelCoord{4, 4, 4};
          const glm::vec3 p = glm::vec3(at.x, at.y, at.z) * source.voxel_size_m;
          EXPECT_LE(p.y, ground_height_m(source, p.x, p.z)) << p.x << ' ' << p.y << ' ' << p.z;
        }
      }
  MapField field(source);
  const glm::vec3 crown(15.0F, ground_height_m(source, 15.0F, 0.0F), 0.0F);
  EXPECT_GT(crown.y, 5.0F) << "the arch stands";
  EXPECT_LT(sample(field, (crown - glm::vec3(0.0F, 1.0F, 0.0F)) / source.voxel_size_m).distance_voxels, 0.0F);
}

TEST(terrain, names_and_kinds_correspond) {
  for (const TerrainSource& source : sources)
    EXPECT_EQ(kind_named<TerrainKind>(name_of(source.kind)), source.kind);
  EXPECT_FALSE(kind_named<TerrainKind>("lava").has_value());
}

}  // namespace
}  // namespace scree
