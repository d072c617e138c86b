// Questions about terrain, against every polygon of the mesh that is exported.
#include <gtest/gtest.h>

#include "bench/support/brute_surface.h"
#include "bench/support/carved_field.h"
#include "shared/query/query.h"
#include "shared/query/vectors.h"

namespace scree {
namespace {

glm::vec3 direction(Random& random) {
  for (;;) {
    const glm::vec3 v(random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F);
    const float squared = glm::dot(v, v);
    if (squared > 0.01F && squared < 1.0F) return glm::vec3(unit_of(glm::dvec3(v)));
  }
}

/// A carved piece of noise around a place of its ground, and the mesh there.
class QueryTerrain : public ::testing::Test {
 protected:
  static constexpr float voxel_m = 0.25F;
  static constexpr float half_m = 8.0F;
  static constexpr double tenth = 0.1;  ///< voxels

  struct World {
    MapField field{{TerrainKind::noise, 3, voxel_m}};
    glm::vec3 middle_m;
    BruteSurface brute;

    World() {
      middle_m = {0.0F, ground_height_m(field.source(), 0.0F, 0.0F), 0.0F};
      roughen(field, middle_m, half_m, 80, 5);
      const int y = static_cast<int>(middle_m.y / voxel_m);
      brute.add_field(field, VoxelBox{{-72, y - 72, -72}, {72, y + 72, 72}});
    }
  };
  static World& world() {
    static World one;
    return one;
  }

  glm::vec3 place(Random& random, float part = 1.0F) const {
    const auto at = [&] { return (random.unit() * 2.0F - 1.0F) * half_m * part; };
    return world().middle_m + glm::vec3{at(), at(), at()};
  }
  glm::dvec3 in_grid(glm::vec3 m) const { return glm::dvec3(m) / static_cast<double>(voxel_m); }

  const BruteSurface& brute = world().brute;
  const QueryScene scene{world().field, {}};
};

TEST_F(QueryTerrain, rays_meet_the_mesh) {
  Random random(1);
  int hits = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 from = place(random), unit = direction(random);
    const auto cast = cast_ray(scene, from, unit, 6.0F);
    ASSERT_TRUE(cast);
    const auto& hit = cast->answer;
    if (hit && hit->inside) {
      EXPECT_EQ(hit->distance_m, 0.0F);
      EXPECT_EQ(hit->place_m, from);
      ++inside;
      continue;
    }
    const auto reference = brute.first_on_line(in_grid(from), unit_of(glm::dvec3(unit)), 6.0 / voxel_m);
    ASSERT_EQ(hit.has_value(), reference.has_value()) << i;
    if (!hit) continue;
    ++hits;
    ASSERT_NEAR(hit->distance_m / voxel_m, *reference, 1e-3) << i;
    EXPECT_LT(glm::dot(hit->normal, unit), 1e-6F);
    EXPECT_NEAR(glm::length(hit->normal), 1.0F, 1e-6F);
    EXPECT_EQ(hit->kind, HitKind::terrain);
  }
  EXPECT_GT(hits, 4000);
  EXPECT_GT(inside, 4000);
}

TEST_F(QueryTerrain, spheres_meet_the_mesh) {
  Random random(2);
  int hits = 0, inside = 0;
  for (int i = 0; i < 1500; ++i) {
    const glm::vec3 from = place(random, 0.6F), unit = direction(random);
    const float radius = 0.02F + random.unit() * (i % 4 == 0 ? 1.5F : 0.3F);
    const auto cast = cast_sphere(scene, from, unit, 4.0F, radius);
    ASSERT_TRUE(cast) << cast.error().message;
    const auto& hit = cast->answer;
    const glm::dvec3 start = in_grid(from), way = unit_of(glm::dvec3(unit));
    const double size = static_cast<double>(radius) / voxel_m;
    if (hit && hit->inside) {
      ++inside;
      EXPECT_TRUE(is_solid(scene, from)->answer || brute.distance(start, glm::dvec3(0.0), 9.0) <= size) << i;
      continue;
    }
    const auto reference = brute.first_of_capsule(start, glm::dvec3(0.0), way, 4.0 / voxel_m, size);
    ASSERT_EQ(hit.has_value(), reference.has_value()) << i;
    if (!hit) continue;
    ++hits;
    ASSERT_NEAR(hit->distance_m / voxel_m, *reference, tenth) << i;
    EXPECT_NEAR(brute.distance(start + way * (double(hit->distance_m) / voxel_m), glm::dvec3(0.0), 9.0), size,
                1e-3);
    EXPECT_NEAR(glm::length(from + unit * hit->distance_m - hit->place_m), radius, 1e-3F);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(inside, 300);
}

TEST_F(QueryTerrain, capsules_meet_the_mesh) {
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 from = place(random, 0.6F) + glm::vec3(0.0F, 2.0F, 0.0F), unit = direction(random);
    const glm::vec3 axis = direction(random) * (random.unit() * 1.2F);
    const float radius = 0.05F + random.unit() * 0.4F;
    const auto cast = cast_capsule(scene, from, from + axis, unit, 4.0F, radius);
    ASSERT_TRUE(cast) << cast.error().message;
    const auto& hit = cast->answer;
    if (hit && hit->inside) continue;
    const glm::dvec3 start = in_grid(from), way = unit_of(glm::dvec3(unit)),
                     long_m = in_grid(from + axis) - start;
    const double size = static_cast<double>(radius) / voxel_m;
    const auto reference = brute.first_of_capsule(start, long_m, way, 4.0 / voxel_m, size);
    ASSERT_EQ(hit.has_value(), reference.has_value()) << i;
    if (!hit) continue;
    ++hits;
    ASSERT_NEAR(hit->distance_m / voxel_m, *reference, tenth) << i;
    EXPECT_NEAR(brute.distance(start + way * (double(hit->distance_m) / voxel_m), long_m, 9.0), size, 1e-3);
  }
  EXPECT_GT(hits, 60);
}

TEST_F(QueryTerrain, the_nearest_surface_and_overlaps_are_the_meshs) {
  Random random(4);
  int found = 0, touching = 0;
  for (int i = 0; i < 1500; ++i) {
    const glm::vec3 at = place(random, 0.7F);
    const float most = 0.1F + random.unit() * 3.0F;
    const auto near = nearest_surface(scene, at, most);
    ASSERT_TRUE(near);
    const double reference = brute.distance(in_grid(at), glm::dvec3(0.0), 2.0 * most / voxel_m) * voxel_m;
    ASSERT_EQ(near->answer.has_value(), reference <= most) << i;
    const bool solid = is_solid(scene, at)->answer;
    EXPECT_EQ(overlap_sphere(scene, at, most)->answer.terrain, solid || reference <= most);
    const auto half = glm::vec3(0.3F + random.unit(), 0.3F, 0.1F + random.unit()) * most;
    const auto lo = in_grid(at - half), hi = in_grid(at + half);
    const bool overlaps = overlap_box(scene, at - half, at + half)->answer.terrain;
    const bool surely = solid || brute.has_place_in(lo, hi, 0.25);
    const bool maybe = solid || brute.has_place_in(lo - 0.3, hi + 0.3, 0.25);
    EXPECT_GE(overlaps, surely) << i;
    EXPECT_LE(overlaps, maybe) << i;
    touching += overlaps ? 1 : 0;
    if (!near->answer) continue;
    ++found;
    EXPECT_NEAR(near->answer->distance_m, reference, 1e-4);
    EXPECT_EQ(near->answer->inside, solid);
    const glm::vec3 off = (at - near->answer->place_m) * (solid ? -1.0F : 1.0F);
    EXPECT_NEAR(glm::dot(off, near->answer->normal), near->answer->distance_m, 1e-3F);
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(touching, 300);
}

/// Rays along axes, at places that are multiples of half voxels, on the ground as it was made and carved.
TEST_F(QueryTerrain, rays_on_the_planes_of_voxels_never_pass) {
  MapField flat({TerrainKind::flat, 1, voxel_m});
  Window window = gather(flat, VoxelBox{{-20, -20, -20}, {20, 20, 20}});
  carve(window, codes_of(box(glm::vec3(0.0F), glm::vec3(6.0F, 9.5F, 7.25F)), window.box));
  scatter(flat, window);
  const QueryScene flat_scene(flat, {});
  for (int x = -50; x <= 50; ++x)
    for (int z = -50; z <= 50; ++z) {
      const glm::vec3 above(static_cast<float>(x) * 0.125F, 3.0F, static_cast<float>(z) * 0.125F);
      const auto down = cast_ray(flat_scene, above, {0.0F, -1.0F, 0.0F}, 100.0F);
      ASSERT_TRUE(down && down->answer) << x << ", " << z;
      EXPECT_GT(down->answer->distance_m, 2.7F);
      EXPECT_LT(down->answer->distance_m, 5.6F);
      if (std::abs(x) > 11 || std::abs(z) > 13) continue;
      for (const glm::vec3 unit :
           {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        const auto aside = cast_ray(flat_scene, {above.x, -1.0F, above.z}, unit, 100.0F);
        ASSERT_TRUE(aside && aside->answer) << x << ", " << z;
        EXPECT_LT(aside->answer->distance_m, 3.7F);
        EXPECT_FALSE(aside->answer->inside);
      }
    }
}

TEST_F(QueryTerrain, a_ball_at_rest_slides_and_leaves) {
  MapField flat({TerrainKind::flat, 1, voxel_m});
  const QueryScene flat_scene(flat, {});
  const auto ground = cast_ray(flat_scene, {0.3F, 2.0F, 0.2F}, {0.0F, -1.0F, 0.0F}, 5.0F)->answer;
  ASSERT_TRUE(ground);
  const glm::vec3 rest = ground->place_m + glm::vec3(0.0F, 0.5F, 0.0F);
  EXPECT_FALSE(cast_sphere(flat_scene, rest, {1.0F, 0.0F, 0.0F}, 10.0F, 0.5F)->answer);
  EXPECT_FALSE(cast_sphere(flat_scene, rest, {0.0F, 1.0F, 0.0F}, 10.0F, 0.5F)->answer);
  const auto down = cast_sphere(flat_scene, rest, {0.0F, -1.0F, 0.0F}, 10.0F, 0.5F)->answer;
  ASSERT_TRUE(down);
  EXPECT_FALSE(down->inside);
  EXPECT_LT(down->distance_m, 1e-3F);
  EXPECT_NEAR(down->normal.y, 1.0F, 1e-4F);
}

TEST_F(QueryTerrain, a_box_holds_what_the_ledger_counts) {
  const Field& field = scene.field();
  const ChunkCoord chunk = chunk_of(VoxelCoord{3, static_cast<int>(world().middle_m.y / voxel_m), 5});
  MassUnits units = 0, filled = 0;
  for (int i = 0; i < 64; ++i) {
    const BrickCoord brick = brick_in_chunk(chunk, i);
    units += brick_mass(field.source(), brick, field.brick(brick), field.materials(brick));
    filled += brick_mass(field.brick(brick));
  }
  const VoxelCoord first = first_voxel(chunk);
  const glm::vec3 lo = glm::vec3(first.x, first.y, first.z) * voxel_m;
  const auto content = box_content(scene, lo, lo + 8.0F);
  ASSERT_TRUE(content);
  EXPECT_GT(units, 0);
  EXPECT_EQ(sum_of(content->answer.masses), units);
  EXPECT_NEAR(content->answer.rock_m3, static_cast<double>(filled) / 254.0 / 64.0, 1e-9);
  // By halves it is the same.
  const glm::vec3 middle = lo + glm::vec3(3.13F, 8.0F, 8.0F), rest = lo + glm::vec3(3.13F, 0.0F, 0.0F);
  MaterialMasses parts = box_content(scene, lo, middle)->answer.masses;
  add(parts, box_content(scene, rest, lo + 8.0F)->answer.masses);
  EXPECT_EQ(parts, content->answer.masses);
}

TEST_F(QueryTerrain, answers_and_costs_are_the_same_again) {
  Random random(9);
  const QueryScene other(world().field, {});
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 from = place(random), unit = direction(random);
    const auto one = cast_ray(scene, from, unit, 8.0F), two = cast_ray(other, from, unit, 8.0F);
    const auto three = cast_ray(scene, from, unit, 8.0F);
    EXPECT_TRUE(one->answer == two->answer && one->answer == three->answer);
    EXPECT_EQ(one->cost.steps, three->cost.steps);
    EXPECT_EQ(one->cost.steps, two->cost.steps);
    EXPECT_EQ(one->cost.chunks, two->cost.chunks);
    const auto ball = cast_sphere(scene, from, unit, 4.0F, 0.4F),
               again = cast_sphere(other, from, unit, 4.0F, 0.4F);
    EXPECT_TRUE(ball->answer == again->answer);
    EXPECT_EQ(ball->cost.steps, again->cost.steps);
  }
}

TEST_F(QueryTerrain, cells_that_are_kept_forget_what_changed) {
  MapField field({TerrainKind::noise, 3, voxel_m});
  FieldCells kept(field);
  Random random(12);
  int differ = 0;
  for (int round = 0; round < 12; ++round) {
    // One carve a round, at the corners of chunks as well.
    const glm::vec3 at = round % 2 == 0 ? place(random, 0.5F) : glm::vec3{8.0F, world().middle_m.y, 0.0F};
    const Shape hole = in_voxels(sphere(at, 0.4F + 0.1F * static_cast<float>(round)), voxel_m);
    Window window = gather(field, band_box(hole));
    carve(window, codes_of(hole, window.box));
    scatter(field, window);
    kept.forget(window.box);
    const QueryScene with(field, {}, kept), fresh(field, {});
    for (int i = 0; i < 300; ++i) {
      const glm::vec3 unit = direction(random), from = at - unit * 3.0F;
      const auto one = cast_ray(with, from, unit, 6.0F), two = cast_ray(fresh, from, unit, 6.0F);
      ASSERT_TRUE(one->answer == two->answer) << round;
      EXPECT_EQ(one->cost.steps, two->cost.steps);
      differ += one->answer && !one->answer->inside ? 1 : 0;
    }
  }
  EXPECT_GT(differ, 300);
}

TEST_F(QueryTerrain, odd_numbers_are_refused) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const glm::vec3 origin(0.0F), up(0.0F, 1.0F, 0.0F);
  for (const float bad : {nan, inf, -inf, 1e30F}) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 place = origin, unit = up;
      place[axis] = bad;
      unit[axis] = bad;
      EXPECT_FALSE(cast_ray(scene, place, up, 1.0F));
      EXPECT_FALSE(cast_ray(scene, origin, unit, 1.0F));
      EXPECT_FALSE(cast_sphere(scene, place, up, 1.0F, 0.5F));
      EXPECT_FALSE(cast_capsule(scene, origin, place, up, 1.0F, 0.5F));
      EXPECT_FALSE(overlap_sphere(scene, place, 1.0F));
      EXPECT_FALSE(overlap_box(scene, origin, place));
      EXPECT_FALSE(nearest_surface(scene, place, 1.0F));
      EXPECT_FALSE(is_solid(scene, place));
      EXPECT_FALSE(box_content(scene, place, origin));
      EXPECT_FALSE(solids_in(scene, origin, place));
    }
    EXPECT_FALSE(cast_ray(scene, origin, up, bad));
    EXPECT_FALSE(cast_sphere(scene, origin, up, 1.0F, bad));
    EXPECT_FALSE(overlap_sphere(scene, origin, bad));
    EXPECT_FALSE(nearest_surface(scene, origin, bad));
  }
  EXPECT_FALSE(cast_ray(scene, origin, glm::vec3(0.0F), 1.0F));
  EXPECT_FALSE(cast_ray(scene, origin, up * 1.1F, 1.0F));
  EXPECT_FALSE(cast_ray(scene, origin, up, -1.0F));
  EXPECT_FALSE(cast_ray(scene, origin, up, 1001.0F));
  EXPECT_FALSE(cast_sphere(scene, origin, up, 100.0F, 8.0F));
  EXPECT_TRUE(cast_sphere(scene, origin + up * 100.0F, up, 40.0F, 8.0F));
  EXPECT_FALSE(overlap_box(scene, up, origin));
  EXPECT_FALSE(box_content(scene, origin, origin + 100.0F));
  QueryMask mask;
  mask.except.resize(1000);
  EXPECT_FALSE(cast_ray(scene, origin, up, 1.0F, mask));
}

}  // namespace
}  // namespace scree
