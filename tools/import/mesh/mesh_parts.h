// A mesh as parts: pieces of surface that belong together, turned so that their insides are inside, and the
// holes in each.
#pragma once

#include "tools/import/mesh/mesh_edges.h"
#include "tools/import/mesh/triangle_mesh.h"

namespace scree {

struct MeshPart {
  std::vector<uint32_t> triangles;  ///< numbers, ascending
  std::vector<EdgeUse> open;        ///< edges with no surface on the other side
  double area_m2 = 0.0;
  double caps_m2 = 0.0;    ///< area of the flat caps that would close its holes
  double volume_m3 = 0.0;  ///< with these caps, by the order of the file's corners
  glm::dvec3 facing_m2{};  ///< the sum of its normals, each as long as the triangle's area
  bool is_cavity = false;  ///< within another part, inside out
  uint32_t within = 0;     ///< of a cavity: the number of the smallest part around it

  /// The share of the whole surface, from 0 to 1.
  double missing() const { return area_m2 > 0.0 ? caps_m2 / (area_m2 + caps_m2) : 0.0; }
};

struct PartFindings {
  size_t turned_triangles = 0;  ///< that stood against their neighbours
  size_t turned_parts = 0;      ///< whose inside was outside
  size_t cavities = 0;
};

/// Turns triangles until neighbours agree, and parts until their insides are inside. Borders that lie within
/// `tolerance_m` of each other count as joined.
std::vector<MeshPart> parts_of(TriangleMesh& mesh, double tolerance_m, PartFindings& found);

/// Those triangles alone.
TriangleMesh part_mesh(const TriangleMesh& mesh, const std::vector<uint32_t>& triangles);

}  // namespace scree
