// The three ways to find the terrain: each carries a body on even ground, notices that the ground was taken
// away, and is the same every time; they can be switched while bodies lie on the ground.
#include "server/colliders/terrain_collider.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/bodies/bodies.h"
#include "server/colliders/nearest_triangle.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "tests/support/bodies_support.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

constexpr TerrainColliderKind kinds[] = {TerrainColliderKind::field, TerrainColliderKind::mesh,
                                         TerrainColliderKind::rays};

BodyShape cube(float half_m) {
  BodyShape shape;
  for (int i = 0; i < 8; ++i)
    shape.hull_m.emplace_back((i & 4) != 0 ? half_m : -half_m, (i & 2) != 0 ? half_m : -half_m,
                              (i & 1) != 0 ? half_m : -half_m);
  shape.mass_kg = 8.0F * half_m * half_m * half_m * builtin_row(material::rock).density_kg_m3;
  shape.inertia_kg_m2 = glm::mat3(shape.mass_kg * half_m * half_m * 2.0F / 3.0F);
  return shape;
}

void rain_cubes(Bodies& bodies, const TerrainSource& source, PieceId count) {
  Random random(42);
  for (PieceId id = 1; id <= count; ++id) {
    const float x = random.unit() * 10.0F, z = random.unit() * 10.0F;
    const float y = ground_height_m(source, x, z) + 1.0F + random.unit() * 5.0F;
    bodies.add(cube(0.15F + 0.3F * random.unit()), body_at(id, {x, y, z}));
  }
}

class TerrainColliders : public ::testing::TestWithParam<TerrainColliderKind> {
 protected:
  BodiesConfig config() const {
    BodiesConfig config;
    config.terrain_collider = GetParam();
    return config;
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, TerrainColliders, ::testing::ValuesIn(kinds), [](const auto& info) {
  return std::string(std::array{"field", "mesh", "rays"}[static_cast<size_t>(info.param)]);
});

TEST_P(TerrainColliders, a_cube_rests_on_flat_ground) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, config());
  bodies.add(cube(0.5F), body_at(1, {0.1F, 3.0F, 0.1F}));
  step(bodies, 180);
  EXPECT_NEAR(bodies.state(1).pose.position_m.y, 0.5F, 0.03F);
  EXPECT_EQ(bodies.contacts().on_terrain, std::vector<PieceId>{1});
}

TEST_P(TerrainColliders, a_sleeping_cube_falls_into_the_hole_that_is_dug_under_it) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, config());
  bodies.add(cube(0.5F), body_at(1, {0.0F, 0.6F, 0.0F}));
  step(bodies, 400);
  ASSERT_EQ(bodies.awake(), 0U);
  dig(field, {0.0F, 0.0F, 0.0F}, 3.0F, bodies);
  step(bodies, 120);
  EXPECT_NEAR(bodies.state(1).pose.position_m.y, -2.5F, 0.35F);
}

TEST_P(TerrainColliders, two_worlds_agree_bit_for_bit) {
  MapField field_a(ground(TerrainKind::noise)), field_b(ground(TerrainKind::noise));
  Bodies a(field_a, config()), b(field_b, config());
  rain_cubes(a, field_a.source(), 40);
  rain_cubes(b, field_b.source(), 40);
  const glm::vec3 hole(5.0F, ground_height_m(field_a.source(), 5.0F, 5.0F), 5.0F);
  for (int tick = 1; tick <= 150; ++tick) {
    a.step();
    b.step();
    if (tick == 90) dig(field_a, hole, 2.0F, a), dig(field_b, hole, 2.0F, b);
    ASSERT_EQ(a.state_hash(), b.state_hash()) << "at tick " << tick;
  }
}

TEST_P(TerrainColliders, another_one_takes_over_and_bodies_stay_where_they_are) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  for (PieceId id = 1; id <= 5; ++id)
    bodies.add(cube(0.4F), body_at(id, {2.0F * static_cast<float>(id), 0.5F, 0.0F}));
  step(bodies, 400);
  const std::vector<BodyState> before = bodies.states();
  bodies.set_terrain_collider(GetParam());
  EXPECT_EQ(bodies.states().front().pose.position_m, before.front().pose.position_m);
  EXPECT_EQ(bodies.awake(), GetParam() == TerrainColliderKind::field ? 0U : 5U);
  step(bodies, 120);
  const std::vector<BodyState> after = bodies.states();
  for (size_t i = 0; i < after.size(); ++i)
    EXPECT_LT(glm::length(after[i].pose.position_m - before[i].pose.position_m), 0.03F) << "body " << i + 1;
  bodies.set_terrain_collider(TerrainColliderKind::field);
  step(bodies, 120);
  EXPECT_NEAR(bodies.state(3).pose.position_m.y, 0.4F, 0.03F);
}

/// Points all over a ball that is stuck in a hillside: what two colliders say of them.
std::vector<TerrainContact> contacts_of(TerrainCollider& collider, glm::vec3 centre_m, float reach_m) {
  Random random(3);
  std::vector<glm::vec3> points;
  while (points.size() < 200) {
    const glm::vec3 p = 2.0F * glm::vec3(random.unit(), random.unit(), random.unit()) - 1.0F;
    if (glm::dot(p, p) <= 1.0F) points.push_back(p);
  }
  std::vector<TerrainContact> found;
  collider.attach(points)->find({centre_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)}, reach_m, found);
  return found;
}

TEST(TerrainCollider, mesh_and_field_see_the_same_ground) {
  MapField field(ground(TerrainKind::noise));
  const auto by_field = make_field_collider(field), by_mesh = make_mesh_collider(field);
  const float reach_m = voxel_m;
  size_t compared = 0;
  for (int i = 0; i < 20; ++i) {
    const float x = 3.1F * static_cast<float>(i), z = 40.0F - 2.3F * static_cast<float>(i);
    const glm::vec3 centre(x, ground_height_m(field.source(), x, z), z);
    const auto fields = contacts_of(*by_field, centre, reach_m),
               meshes = contacts_of(*by_mesh, centre, reach_m);
    for (const TerrainContact& m : meshes)
      for (const TerrainContact& f : fields) {
        if (f.point != m.point || std::abs(f.distance_m) > voxel_m) continue;
        EXPECT_NEAR(m.distance_m, f.distance_m, 0.35F * voxel_m);
        ++compared;
      }
  }
  EXPECT_GT(compared, 500U);
}

TEST(TerrainCollider, a_mesh_is_made_anew_where_the_terrain_changed) {
  MapField field(ground(TerrainKind::flat));
  TerrainMesh mesh(field);
  const VoxelBox box{{-8, -8, -8}, {8, 8, 8}};
  const auto lowest = [&] {
    float y = 1e9F;
    for (const TerrainTriangle& triangle : mesh.near(box))
      for (const glm::vec3& corner : triangle.corners) y = std::min(y, corner.y);
    return y;
  };
  EXPECT_NEAR(lowest(), 0.0F, 0.1F);
  dig(field, {0.0F, 0.0F, 0.0F}, 1.5F, mesh);
  EXPECT_NEAR(lowest(), -6.0F, 0.3F);
}

TEST(TerrainCollider, the_nearest_triangle_knows_the_side_also_beyond_an_edge) {
  // A ridge along z, whose faces fall off steeply on both sides, seen from right above it and from beside it.
  const glm::vec3 top_a(0.0F, 0.0F, -4.0F), top_b(0.0F, 0.0F, 4.0F);
  const float slope = std::sqrt(1.0F / 5.0F);
  const TerrainTriangle left{{top_a, top_b, glm::vec3(-2.0F, -4.0F, 0.0F)}, {-2.0F * slope, slope, 0.0F}};
  const TerrainTriangle right{{top_a, top_b, glm::vec3(2.0F, -4.0F, 0.0F)}, {2.0F * slope, slope, 0.0F}};
  const TriangleBins bins({left, right}, {{-8, -8, -8}, {8, 8, 8}});
  const auto above = bins.nearest({0.1F, 1.0F, 0.0F}, 2.0F);
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->distance, std::sqrt(1.01F), 1e-3F);
  const auto within = bins.nearest({0.1F, -1.0F, 0.0F}, 2.0F);
  ASSERT_TRUE(within);
  EXPECT_LT(within->distance, 0.0F);
  EXPECT_GT(within->normal.x, 0.0F) << "the right face is nearer";
  EXPECT_FALSE(bins.nearest({0.0F, 3.0F, 0.0F}, 2.0F));
}

}  // namespace
}  // namespace scree
