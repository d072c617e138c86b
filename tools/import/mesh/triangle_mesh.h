// Triangles from a file, welded, in the world's metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/field/brick_materials.h"

namespace scree {

struct TriangleMesh {
  using Triangle = std::array<uint32_t, 3>;

  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;  ///< counterclockwise from outside
  /// What each triangle says of its rock. Empty: none says anything.
  std::vector<VoxelMaterial> materials{};

  void add(const Triangle& triangle, VoxelMaterial material) {
    triangles.push_back(triangle);
    materials.push_back(material);
  }
  VoxelMaterial material_of(size_t triangle) const {
    return materials.empty() ? ground_own : materials[triangle];
  }
};

struct WeldFindings {
  size_t joined_points = 0;        ///< that lay as near as the rounding of the file's numbers
  size_t two_sided_triangles = 0;  ///< second sides of surfaces that show both, left out
};

/// Points at the same place become one, and at the mesh's border also those within `rounding_m`. Triangles
/// without an area go, and the second of two with the same corners in the same order. Two with opposite
/// orders cancel each other, unless a whole connected part has two sides: one of them is left.
WeldFindings weld(TriangleMesh& mesh, double rounding_m);

/// Twice its normal times its area.
glm::dvec3 normal_of(const TriangleMesh& mesh, size_t triangle);

/// By the divergence theorem; of a closed mesh, cubic metres.
double volume_m3(const TriangleMesh& mesh);

}  // namespace scree
