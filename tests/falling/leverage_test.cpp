// Leverage: beams of every material break where and when the formula of bending says.
#include <cmath>
#include <gtest/gtest.h>
#include <ranges>
#include <vector>

#include "shared/falling/support_search.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

/// Whether a beam of so many metres that sticks out of a wall breaks; its width is 2 m.
bool beam_breaks(Material material, float height_m, float length_m) {
  MapField field(flat_terrain);
  PieceTable none;
  for (const Shape& shape :
       {box({-3.0F, 5.0F, 0.1F}, {2.9F, 8.0F, 6.0F}),
        box({-0.1F + 0.5F * length_m - 0.5F, 7.3F, 0.1F}, {0.5F * length_m + 0.5F, 0.5F * height_m, 1.0F})})
    apply(FillOperation{shape}, field, none);
  for (float x = -6.0F; x < 20.0F; x += 5.0F)  // whole bricks
    apply(PaintOperation{box({x, 6.0F, 0.0F}, glm::vec3(8.0F)), material}, field, none);
  const SupportFound found =
      find_overloads(field, builtin_palette(), std::vector<BrickCoord>{{0, 3, 0}, {-1, 3, 0}}, 9);
  EXPECT_FALSE(found.given_up);
  if (found.overloads.empty()) return false;
  EXPECT_EQ(found.overloads.size(), 1U);
  const VoxelBox& neck = found.overloads[0].necks.at(0).box;
  EXPECT_LE(std::abs(neck.lo.x + neck.hi.x), 8) << "it breaks at its root";
  return true;
}

TEST(support, a_beam_breaks_at_a_length_that_grows_with_the_root_of_its_height) {
  for (const Material material : ground_layers)
    for (const float height_m : std::vector{2.5F, 1.5F, 4.0F} | std::views::take(rounds(3, 1))) {
      const MaterialRow& row = builtin_row(material);
      const float expected_m =
          std::sqrt(row.bearing.bending_pa * height_m / (3.0F * row.density_kg_m3 * 9.80665F));
      float holds_m = 0.5F * expected_m, breaks_m = 1.3F * expected_m;
      ASSERT_FALSE(beam_breaks(material, height_m, holds_m)) << row.name << " " << height_m;
      ASSERT_TRUE(beam_breaks(material, height_m, breaks_m)) << row.name << " " << height_m;
      for (int i = 0; i < 8; ++i) {
        const float between_m = 0.5F * (holds_m + breaks_m);
        (beam_breaks(material, height_m, between_m) ? breaks_m : holds_m) = between_m;
      }
      EXPECT_NEAR(breaks_m, expected_m, 0.1F * expected_m) << row.name << " " << height_m;
    }
}

}  // namespace
}  // namespace scree
