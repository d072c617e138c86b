#include "shared/query/surface_ray.h"

#include <gtest/gtest.h>

#include "bench/support/brute_surface.h"
#include "bench/support/carved_field.h"
#include "shared/query/field_cells.h"
#include "shared/query/vectors.h"
#include "shared/query/volume_cells.h"
#include "tests/support/voxel_cube.h"

namespace scree {
namespace {

glm::dvec3 random_unit(Random& random) {
  for (;;) {
    const glm::dvec3 v(random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F);
    const double squared = glm::dot(v, v);
    if (squared > 0.01 && squared < 1.0) return unit_of(v);
  }
}

/// How a random direction is made special: mostly not at all, else along axes or diagonals.
glm::dvec3 special(glm::dvec3 unit, uint32_t choice) {
  glm::dvec3 v = unit;
  if (choice % 4 == 1) v[static_cast<int>(choice / 4 % 3)] = 0.0;
  if (choice % 4 == 2) {
    const int axis = static_cast<int>(choice / 4 % 3);
    v = glm::dvec3(0.0);
    v[axis] = unit[axis] < 0.0 ? -1.0 : 1.0;
  }
  if (choice % 4 == 3) v = glm::dvec3(v.x < 0 ? -1 : 1, v.y < 0 ? -1 : 1, choice % 8 == 3 ? 0 : 1);
  return unit_of(v);
}

/// Casts from places at multiples of parts of a voxel or anywhere: every one must meet what the reference
/// meets.
void expect_agreement(CellSource& cells, const BruteSurface& brute, glm::dvec3 middle, double half,
                      int casts) {
  Random random(7);
  int hits = 0;
  for (int i = 0; i < casts; ++i) {
    glm::dvec3 from =
        middle + glm::dvec3(random.unit() - 0.5F, random.unit() - 0.5F, random.unit() - 0.5F) * (2.0 * half);
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t grid = random.below(5);  // on planes of voxels, of cells' middles, of vertices' steps
      const double steps = grid == 0 ? 1.0 : (grid == 1 ? 2.0 : 256.0);
      if (grid < 3) from[axis] = static_cast<double>(floor_to_int(from[axis] * steps)) / steps;
    }
    const Line line{from, special(random_unit(random), random.below(24))};
    uint32_t steps = 0;
    const double most = half;
    const auto hit = first_on_line(cells, line, most, steps);
    const auto reference = brute.first_on_line(line.from, line.unit, most);
    if (reference) {
      ++hits;
      // A start on a surface that it leaves meets nothing; the reference may.
      if (*reference < 1e-6) continue;
      ASSERT_TRUE(hit.has_value()) << i << " through at " << *reference;
      ASSERT_NEAR(hit->along, *reference, 1e-4) << i;
      EXPECT_NEAR(glm::length(hit->normal), 1.0, 1e-9);
    } else if (hit) {
      // The reference leaves out what lies along the ray.
      ASSERT_LT(brute.distance(hit->place, glm::dvec3(0.0), 1.0), 1e-4) << i;
    }
  }
  EXPECT_GT(hits, casts / 4);
}

TEST(SurfaceRay, meets_what_a_carved_fields_mesh_has) {
  MapField field({TerrainKind::noise, 3, 0.25F});
  const float ground_m = ground_height_m(field.source(), 0.0F, 0.0F);
  roughen(field, {0.0F, ground_m, 0.0F}, 8.0F, 80, 5);
  const int middle = static_cast<int>(ground_m / 0.25F);
  BruteSurface brute;
  brute.add_field(field, VoxelBox{{-64, middle - 64, -64}, {64, middle + 64, 64}}.grown(2));
  FieldCells cells(field);
  expect_agreement(cells, brute, {0.0, middle, 0.0}, 32.0, 20000);
}

TEST(SurfaceRay, meets_what_noise_without_any_smoothness_has) {
  Random random(11);
  Window noise(cube(-12, 12));
  for (Code& code : noise.codes)
    code = static_cast<Code>((random.below(8) < 2 ? -1 : 1) * static_cast<int>(random.below(127)));
  BruteSurface brute;
  brute.add(surface_nets_closed(noise));
  VolumeCells cells(noise);
  expect_agreement(cells, brute, glm::dvec3(0.0), 16.0, 5000);
}

/// From every place a ray to a far place outside crosses the surface an even number of times, or odd inside.
TEST(SurfaceRay, sides_are_those_of_the_mesh) {
  Window window(cube(-16, 16));
  for (int x = -16; x < 16; ++x)
    for (int y = -16; y < 16; ++y)
      for (int z = -16; z < 16; ++z)
        window.at(x, y, z) = encode(std::max(glm::length(glm::vec3(x, y, z)) - 13.3F,
                                             6.2F - glm::length(glm::vec3(x - 3, y - 2, z))));
  VolumeCells cells(window);
  BruteSurface brute;
  brute.add(surface_nets_closed(window));
  Random random(3);
  uint32_t steps = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 place = (glm::dvec3(random.unit(), random.unit(), random.unit()) - 0.5) * 32.0;
    const glm::dvec3 unit = random_unit(random);
    int crossings = 0;
    for (double along = 0.0; along < 100.0; ++crossings) {
      const auto next = brute.first_on_line(place + unit * along, unit, 100.0);
      if (!next) break;
      along += *next + 1e-7;
    }
    EXPECT_EQ(is_in_rock(cells, place, steps), crossings % 2 == 1) << i;
  }
}

}  // namespace
}  // namespace scree
