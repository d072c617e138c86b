#include "shared/surface/dual_vertex.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Weight that holds a vertex at the mean of the crossings where the planes say nothing, for each plane.
constexpr float mean_weight = 0.02F;

/// A plane that passes by the crossing farther away is of another face.
constexpr float same_face_voxels = 0.1F;

/// The crossed edge's ends, from the cell's lowest corner.
std::array<VoxelCoord, 2> ends_of(const LeafCrossing& crossing) {
  const auto low = [&](int i) { return crossing.axis != i && crossing.at[i] > 0.5F ? 1 : 0; };
  const VoxelCoord from{low(0), low(1), low(2)};
  const int axis = crossing.axis;
  return {from, from + VoxelCoord{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}};
}

}  // namespace

glm::vec3 DualVertices::place(VoxelCoord cell, std::span<const LeafCrossing> crossings) {
  const glm::vec3 mean = mean_of(crossings);
  const Window& window = faces_.window();
  glm::mat3 a(0.0F);
  glm::vec3 b(0.0F);
  float known = 0.0F;
  for (const LeafCrossing& crossing : crossings)
    for (const VoxelCoord end : ends_of(crossing)) {
      const VoxelCoord point = cell + end;
      const PointFace* face = faces_.at(window.index(point.x, point.y, point.z));
      if (face == nullptr) continue;
      const float off = face->distance + glm::dot(face->normal, crossing.at - as_vector(end));
      if (std::abs(off) > same_face_voxels) continue;
      a += glm::outerProduct(face->normal, face->normal);
      b -= face->normal * (face->distance + glm::dot(face->normal, mean - as_vector(end)));
      ++known;
    }
  if (known == 0.0F) return mean;
  a += glm::mat3(mean_weight * known);
  // Outside, it could lie beyond a thin wall's other side.
  return glm::clamp(mean + glm::inverse(a) * b, glm::vec3(0.0F), glm::vec3(1.0F));
}

}  // namespace scree
