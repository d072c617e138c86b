#include "shared/field/shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/field/brick.h"

namespace scree {

namespace {

bool finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Bounds {
  glm::vec3 lo;
  glm::vec3 hi;
};

Bounds bounds_of(const Shape& shape) {
  const glm::vec3 radius(shape.radius_m);
  switch (shape.kind) {
    case ShapeKind::box:
      return {shape.a - shape.b - radius, shape.a + shape.b + radius};
    case ShapeKind::capsule:
      return {glm::min(shape.a, shape.b) - radius, glm::max(shape.a, shape.b) + radius};
    case ShapeKind::sphere:
    case ShapeKind::crater:
      return {shape.a - radius, shape.a + radius};
  }
  CHECK(is_known(shape.kind));
  return {};
}

float sphere_distance(const Shape& shape, glm::vec3 p) {
  const glm::vec3 off = p - shape.a;
  return std::sqrt(glm::dot(off, off)) - shape.radius_m;
}

float box_distance(const Shape& shape, glm::vec3 p) {
  const glm::vec3 q = glm::abs(p - shape.a) - shape.b;
  const glm::vec3 outside = glm::max(q, glm::vec3(0.0F));
  const float inside = std::min(std::max(q.x, std::max(q.y, q.z)), 0.0F);
  return std::sqrt(glm::dot(outside, outside)) + inside - shape.radius_m;
}

float capsule_distance(const Shape& shape, glm::vec3 p) {
  const glm::vec3 along = shape.b - shape.a;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0.0F ? std::clamp(glm::dot(p - shape.a, along) / length2, 0.0F, 1.0F) : 0.0F;
  const glm::vec3 off = p - (shape.a + along * t);
  return std::sqrt(glm::dot(off, off)) - shape.radius_m;
}

}  // namespace

Shape in_voxels(const Shape& shape, float voxel_size_m) {
  CHECK(voxel_size_m > 0.0F);
  return {shape.kind, shape.a / voxel_size_m, shape.b / voxel_size_m, shape.radius_m / voxel_size_m};
}

float distance(const Shape& shape, glm::vec3 p) {
  switch (shape.kind) {
    case ShapeKind::box:
      return box_distance(shape, p);
    case ShapeKind::capsule:
      return capsule_distance(shape, p);
    case ShapeKind::sphere:
    case ShapeKind::crater:
      return sphere_distance(shape, p);
  }
  CHECK(is_known(shape.kind));
  return 0.0F;
}

VoxelBox band_box(const Shape& shape_voxels) {
  const Bounds bounds = bounds_of(shape_voxels);
  const glm::vec3 lo = bounds.lo - band_voxels;
  const glm::vec3 hi = bounds.hi + band_voxels;
  return {{floor_to_int(lo.x), floor_to_int(lo.y), floor_to_int(lo.z)},
          {floor_to_int(hi.x) + 2, floor_to_int(hi.y) + 2, floor_to_int(hi.z) + 2}};
}

glm::vec3 centre_of(const Shape& shape) {
  const Bounds bounds = bounds_of(shape);
  return (bounds.lo + bounds.hi) * 0.5F;
}

float reach_of(const Shape& shape) {
  const auto longest = [](glm::vec3 v) { return std::max(v.x, std::max(v.y, v.z)); };
  switch (shape.kind) {
    case ShapeKind::box:
      return longest(shape.b) + shape.radius_m;
    case ShapeKind::capsule:
      return longest(glm::abs(shape.b - shape.a)) * 0.5F + shape.radius_m;
    case ShapeKind::sphere:
    case ShapeKind::crater:
      return shape.radius_m;
  }
  CHECK(is_known(shape.kind));
  return 0.0F;
}

Result<void> validate(const Shape& shape) {
  TRY(validate_kind(shape.kind, "kind of shape"));
  if (!finite(shape.a) || !finite(shape.b)) return fail("the shape's position is not a finite number");
  if (!std::isfinite(shape.radius_m)) return fail("the radius is not a finite number");
  if (shape.radius_m < 0.0F) return fail("the radius is negative");
  switch (shape.kind) {
    case ShapeKind::box:
      if (shape.b.x <= 0.0F || shape.b.y <= 0.0F || shape.b.z <= 0.0F)
        return fail("a half extent of the box is not positive");
      break;
    case ShapeKind::sphere:
    case ShapeKind::capsule:
    case ShapeKind::crater:
      if (shape.radius_m == 0.0F) return fail("the radius is zero");
      break;
  }
  return {};
}

}  // namespace scree
