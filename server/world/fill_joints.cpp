#include "server/world/fill_joints.h"

#include <algorithm>
#include <cmath>

#include "server/world/rules.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// A face of a box in voxels: that towards the higher or the lower end of an axis.
struct Face {
  int axis = 0;
  int outward = 1;  ///< or −1
  int plane = 0;    ///< of voxels, on which it lies
};

VoxelCoord out_of(const Face& face) {
  glm::ivec3 step(0);
  step[face.axis] = face.outward;
  return {step.x, step.y, step.z};
}

Code code_at(const Shape& in_field, VoxelCoord v) {
  return encode(distance(in_field, glm::vec3(v.x, v.y, v.z)));
}

/// Bounds of the voxels of the plane in which the face lies on the terrain's surface, rock beyond it; empty
/// where there is none.
VoxelBox touched(const Shape& in_field, const Face& face, Field& field) {
  glm::ivec3 lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = axis == face.axis ? face.plane : floor_to_int(in_field.a[axis] - in_field.b[axis]);
    hi[axis] = axis == face.axis ? face.plane + 1 : floor_to_int(in_field.a[axis] + in_field.b[axis]) + 2;
  }
  const VoxelBox layer{{lo.x, lo.y, lo.z}, {hi.x, hi.y, hi.z}};
  const Window window = gather(field, layer.grown(1));
  const VoxelCoord out = out_of(face);
  VoxelBox found{layer.hi, layer.lo};
  for (int x = layer.lo.x; x < layer.hi.x; ++x)
    for (int y = layer.lo.y; y < layer.hi.y; ++y)
      for (int z = layer.lo.z; z < layer.hi.z; ++z) {
        const VoxelCoord v{x, y, z};
        if (window.at(x, y, z) != 0 || window.at(x + out.x, y + out.y, z + out.z) >= 0) continue;
        if (code_at(in_field, v) != 0 || code_at(in_field, v - out) >= 0) continue;
        found.lo = {std::min(found.lo.x, x), std::min(found.lo.y, y), std::min(found.lo.z, z)};
        found.hi = {std::max(found.hi.x, x + 1), std::max(found.hi.y, y + 1), std::max(found.hi.z, z + 1)};
      }
  return found;
}

/// The slab about those voxels, no wider than the fill.
Shape slab_about(const VoxelBox& voxels, const Shape& in_field, int axis, float voxel_size_m) {
  glm::vec3 lo = glm::vec3(voxels.lo.x, voxels.lo.y, voxels.lo.z) - 0.5F;
  glm::vec3 hi = glm::vec3(voxels.hi.x, voxels.hi.y, voxels.hi.z) - 0.5F;
  for (int other = 0; other < 3; ++other) {
    if (other == axis) continue;
    lo[other] = std::max(lo[other], in_field.a[other] - in_field.b[other]);
    hi[other] = std::min(hi[other], in_field.a[other] + in_field.b[other]);
  }
  return box(0.5F * (lo + hi) * voxel_size_m, 0.5F * (hi - lo) * voxel_size_m);
}

std::vector<Shape> joints_of(const Shape& shape, Field& field) {
  std::vector<Shape> joints;
  const float dx = field.source().voxel_size_m;
  const Shape in_field = in_voxels(shape, dx);
  for (int axis = 0; axis < 3; ++axis)
    for (const int outward : {-1, 1}) {
      const float place = in_field.a[axis] + static_cast<float>(outward) * in_field.b[axis];
      const int plane = floor_to_int(place + 0.5F);
      if (encode(place - static_cast<float>(plane)) != 0) continue;
      const VoxelBox voxels = touched(in_field, {axis, outward, plane}, field);
      if (voxels.empty()) continue;
      const Shape joint = slab_about(voxels, in_field, axis, dx);
      if (validate(Operation(FillOperation{joint}), {}, dx)) joints.push_back(joint);
    }
  return joints;
}

}  // namespace

std::vector<Shape> with_joints(const Shape& shape, Field& field, uint32_t by_rules) {
  std::vector<Shape> shapes;
  if (shape.kind == ShapeKind::box && by_rules >= rules::joints) shapes = joints_of(shape, field);
  shapes.push_back(shape);
  return shapes;
}

}  // namespace scree
