// A slope of rock in the air, as flat as codes allow, and bodies to put on it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/field/paint.h"
#include "tests/support/bodies_support.h"
#include "tests/support/materials.h"

namespace scree {

/// Goes through the point, and down towards +x; from there it reaches 24 voxels up and 56 down the slope.
struct Slope {
  glm::vec3 at_m{0.3F, 24.0F, 0.2F};
  float angle = 0.0F;

  glm::vec3 normal() const { return {std::sin(angle), std::cos(angle), 0.0F}; }
  glm::vec3 down() const { return {std::cos(angle), -std::sin(angle), 0.0F}; }
  /// From level axes to the slope's.
  glm::quat turn() const { return glm::angleAxis(-angle, glm::vec3(0.0F, 0.0F, 1.0F)); }
};

inline void lay(Field& field, const Slope& slope, Material material) {
  const glm::vec3 at = slope.at_m / voxel_m;
  const VoxelCoord middle{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
  Window window(
      {{middle.x - 24, middle.y - 64, middle.z - 16}, {middle.x + 56, middle.y + 32, middle.z + 16}});
  for (int x = window.box.lo.x; x < window.box.hi.x; ++x)
    for (int y = window.box.lo.y; y < window.box.hi.y; ++y)
      for (int z = window.box.lo.z; z < window.box.hi.z; ++z)
        window.at(x, y, z) = encode(glm::dot(glm::vec3(x, y, z) - at, slope.normal()));
  scatter(field, window);
  paint_bricks(field, in_voxels(box(slope.at_m, glm::vec3(18.0F)), voxel_m), material);
}

inline BodyShape box_shape(glm::vec3 half_m) {
  BodyShape shape;
  for (int i = 0; i < 8; ++i)
    shape.hull_m.emplace_back((i & 4) != 0 ? half_m.x : -half_m.x, (i & 2) != 0 ? half_m.y : -half_m.y,
                              (i & 1) != 0 ? half_m.z : -half_m.z);
  shape.mass_kg = 8.0F * half_m.x * half_m.y * half_m.z * builtin_row(material::rock).density_kg_m3;
  const glm::vec3 squares = half_m * half_m;
  const glm::vec3 sums(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
  for (int axis = 0; axis < 3; ++axis) shape.inertia_kg_m2[axis][axis] = sums[axis] * shape.mass_kg / 3.0F;
  return shape;
}

/// A ball, of so many corners spread evenly.
inline BodyShape ball_shape(float radius_m, int corners) {
  BodyShape shape;
  for (int i = 0; i < corners; ++i) {
    const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(corners);
    const float around = 2.3999632F * static_cast<float>(i);  // the golden angle
    const float r = std::sqrt(1.0F - y * y);
    shape.hull_m.push_back(radius_m * glm::vec3(r * std::cos(around), y, r * std::sin(around)));
  }
  shape.mass_kg = 4.18879F * radius_m * radius_m * radius_m * builtin_row(material::rock).density_kg_m3;
  for (int axis = 0; axis < 3; ++axis)
    shape.inertia_kg_m2[axis][axis] = 0.4F * shape.mass_kg * radius_m * radius_m;
  return shape;
}

/// A body's state at rest on the slope, its middle so high over it.
inline BodyState on_slope(PieceId id, const Slope& slope, float height_m) {
  BodyState state = body_at(id, slope.at_m + slope.normal() * height_m);
  state.pose.rotation = slope.turn();
  return state;
}

}  // namespace scree
