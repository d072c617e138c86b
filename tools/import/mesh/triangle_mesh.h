// Triangles from a file, welded, in the world's metres; and what is wrong with them as the surface of a
// solid.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/field/material.h"

namespace scree {

struct TriangleMesh {
  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counterclockwise from outside
  std::optional<Material> material{};              ///< if the file's name for it is one of ours
};

/// Points at the same place become one; triangles without an area, and the second of two with the same
/// corners in the same order, go.
void weld(TriangleMesh& mesh);

struct MeshRepair {
  size_t open_edges = 0;    ///< that have no triangle, or not the right number of them, on the other side
  size_t parts = 0;         ///< connected ones
  size_t turned_parts = 0;  ///< whose inside was outside
};

/// Turns the parts whose inside is outside, but for those that lie within others: they are cavities.
MeshRepair turn_inside_in(TriangleMesh& mesh);

/// By the divergence theorem; of a closed mesh, cubic metres.
double volume_m3(const TriangleMesh& mesh);

}  // namespace scree
