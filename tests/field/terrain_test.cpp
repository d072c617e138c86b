// Generated terrain: seamless, repeatable, a distance field.
#include "shared/field/terrain.h"

#include <cmath>
#include <gtest/gtest.h>

#include "shared/field/field.h"

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

TEST(terrain, names_and_kinds_correspond) {
  for (const TerrainSource& source : sources)
    EXPECT_EQ(kind_named<TerrainKind>(name_of(source.kind)), source.kind);
  EXPECT_FALSE(kind_named<TerrainKind>("lava").has_value());
}

}  // namespace
}  // namespace scree
