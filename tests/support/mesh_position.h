// Where a mesh's vertices are, in the steps that all meshes share: for meshes that make one surface.
#pragma once

#include <array>

#include "shared/surface/surface_mesh.h"

namespace scree {

using MeshPosition = std::array<int, 3>;

inline MeshPosition position_of(const SurfaceMesh& mesh, uint32_t index) {
  const auto& p = mesh.vertices[index].position;
  return {mesh.origin.x * surface_steps + p[0], mesh.origin.y * surface_steps + p[1],
          mesh.origin.z * surface_steps + p[2]};
}

}  // namespace scree
