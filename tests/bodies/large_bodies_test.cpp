// Bodies whose points lie far apart read the bricks about these alone: the same codes as the field has. Fast
// bodies share the new ground of a step.
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "server/bodies/bodies.h"
#include "server/bodies/limits.h"
#include "server/bodies/seen_chunks.h"
#include "server/colliders/limits.h"
#include "server/colliders/point_bricks.h"
#include "server/colliders/terrain_collider.h"
#include "shared/base/random.h"
#include "tests/support/bodies_support.h"
#include "tests/support/tilted_ground.h"

namespace scree {
namespace {

/// Points of a box's faces.
std::vector<glm::vec3> points_of_box(float half_m) {
  std::vector<glm::vec3> points;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x * x == 4 || y * y == 4 || z * z == 4) points.push_back(0.5F * half_m * glm::vec3(x, y, z));
  return points;
}

TEST(LargeBodies, their_points_find_what_the_field_has) {
  MapField field(ground(TerrainKind::canyon));
  PieceTable pieces;
  apply(FillOperation{box({0.0F, 24.0F, 0.0F}, glm::vec3(2.0F))}, field, pieces);
  const std::vector<glm::vec3> points_m = points_of_box(8.0F);
  const auto collider = make_terrain_collider(TerrainColliderKind::field, field);
  const auto probe = collider->attach(points_m);
  Random random(5);
  size_t listed = 0;
  for (int i = 0; i < 60; ++i) {
    const auto unit = [&] { return 2.0F * random.unit() - 1.0F; };
    const glm::vec3 place_m(30.0F * unit(), 14.0F + 14.0F * unit(), 30.0F * unit());
    const glm::quat turn = glm::normalize(glm::quat(unit(), unit(), unit(), 1.5F));
    if (i % 10 == 9) {
      const Shape shape = sphere(place_m, 3.0F);
      apply(FillOperation{shape}, field, pieces);
      probe->terrain_changed(band_box(in_voxels(shape, voxel_m)));
    }
    std::vector<TerrainContact> found;
    probe->find({place_m, turn}, 0.6F, found);
    const glm::mat3 turned = glm::mat3_cast(turn);
    size_t expected = 0;
    for (size_t k = 0; k < points_m.size(); ++k) {
      const FieldSample at = sample(field, (place_m + turned * points_m[k]) / voxel_m);
      const float distance_m = at.distance_voxels * voxel_m;
      if (distance_m >= 0.6F) continue;
      ++expected;
      const auto one = std::ranges::find(found, static_cast<int>(k), &TerrainContact::point);
      ASSERT_NE(one, found.end()) << "point " << k << " of place " << i;
      EXPECT_EQ(one->distance_m, distance_m);
    }
    EXPECT_EQ(found.size(), expected);
    listed += expected;
  }
  EXPECT_GT(listed, 500U);
}

TEST(LargeBodies, ground_that_is_not_generated_is_air_as_generated) {
  size_t above = 0;
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::noise, TerrainKind::canyon}) {
    const TerrainSource source = ground(kind);
    for (int x = -3; x < 3; ++x)
      for (int y = -2; y < 5; ++y) {
        const ChunkCoord chunk{x, y, x * x - 2};
        const GeneratedChunk generated = generate_chunk(source, chunk);
        for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
          if (!is_above_ground(source, brick_in_chunk(chunk, i))) continue;
          ++above;
          EXPECT_EQ(generated.bricks[static_cast<size_t>(i)], &air_brick());
        }
      }
  }
  EXPECT_GT(above, 1000U);
}

TEST(LargeBodies, a_step_leads_through_so_much_new_ground) {
  const MapField field(ground(TerrainKind::flat));
  SeenChunks seen(field);
  const auto at = [](int chunk) {
    const VoxelCoord first = first_voxel(ChunkCoord{chunk, 0, 0});
    return VoxelBox{first, first + VoxelCoord{4, 4, 4}};
  };
  seen.begin_step();
  int entered = 0;
  for (int chunk = 0; chunk < 100; ++chunk) entered += seen.enter(at(chunk)) ? 1 : 0;
  EXPECT_EQ(entered, static_cast<int>(limits::new_chunks_a_step));
  EXPECT_TRUE(seen.enter(at(3))) << "it is known";
  const VoxelCoord high = first_voxel(ChunkCoord{500, 40, 0});
  EXPECT_TRUE(seen.enter({high, high + VoxelCoord{4, 4, 4}})) << "there is no ground";
  seen.begin_step();
  EXPECT_TRUE(seen.enter(at(60))) << "the next step has room again";
  const VoxelCoord far = first_voxel(ChunkCoord{1000, 0, 0});
  EXPECT_FALSE(seen.enter({far, far + VoxelCoord{2000, 4, 4}}));
  seen.begin_step();
  EXPECT_TRUE(seen.enter({far, far + VoxelCoord{2000, 4, 4}})) << "more than a step has goes first";
}

}  // namespace
}  // namespace scree
