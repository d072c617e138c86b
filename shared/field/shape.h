// Solids to carve with and to fill.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/field/coord.h"

namespace scree {

enum class ShapeKind : uint8_t { sphere = 0, box = 1, capsule = 2, crater = 3 };

struct ShapeRow {
  std::string_view name;
  bool has_b;  ///< Shape::b means something; else messages leave it out
};

constexpr ShapeRow row_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return {.name = "sphere", .has_b = false};
    case ShapeKind::box:
      return {.name = "box", .has_b = true};
    case ShapeKind::capsule:
      return {.name = "capsule", .has_b = true};
    case ShapeKind::crater:
      return {.name = "crater", .has_b = false};
  }
  return {};
}

/// In metres. sphere: centre a, radius. box: centre a, half extents b, corners rounded by radius (≥ 0).
/// capsule: from a to b, radius. crater: rough rock within the ball of centre a and this radius (crater.h).
struct Shape {
  ShapeKind kind = ShapeKind::sphere;
  glm::vec3 a{0.0F};
  glm::vec3 b{0.0F};
  float radius_m = 0.0F;

  bool operator==(const Shape&) const = default;
};

inline Shape sphere(glm::vec3 centre_m, float radius_m) {
  return {ShapeKind::sphere, centre_m, glm::vec3(0.0F), radius_m};
}
inline Shape box(glm::vec3 centre_m, glm::vec3 half_extents_m) {
  return {ShapeKind::box, centre_m, half_extents_m, 0.0F};
}
inline Shape capsule(glm::vec3 from_m, glm::vec3 to_m, float radius_m) {
  return {ShapeKind::capsule, from_m, to_m, radius_m};
}
inline Shape crater(glm::vec3 centre_m, float radius_m) {
  return {ShapeKind::crater, centre_m, glm::vec3(0.0F), radius_m};
}

/// The shape with every length divided by the voxel size.
Shape in_voxels(const Shape& shape, float voxel_size_m);

/// Signed distance from p to the shape's surface, negative inside; exact, in the shape's own unit. For a
/// crater it is the distance to its ball, in which it lies: the place of its wall depends on the grid
/// (codes_of).
float distance(const Shape& shape, glm::vec3 p);

/// The voxels within the shape (in voxels) or less than the narrow band away from it.
VoxelBox band_box(const Shape& shape_voxels);

/// Centre of the shape's bounds; in the shape's unit.
glm::vec3 centre_of(const Shape& shape);
/// Half the longest extent of the shape's bounds, from its lengths alone: the place does not round it. For a
/// capsule it is as exact as the places of its ends.
float reach_of(const Shape& shape);

/// Refuses what no world can take: an unknown kind, numbers that are not finite, radii that are negative,
/// a shape without volume.
Result<void> validate(const Shape& shape);

}  // namespace scree
