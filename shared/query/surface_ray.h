// Where a ray meets the polygons of a surface, and which side of them a place is on.
//
// The ray walks over the layers of cells along its longest axis, and tests the polygons in the cells that it
// comes within 1/4096 voxel of. Blocks of 8³ cells without surface cost one look. Corners are projected along
// the ray onto multiples of 2^-20 voxel. There, which side of an edge the ray passes is decided in integers,
// the same for both triangles of the edge (after Woop, Benthin and Wald 2013): no ray slips through between
// triangles. Units: voxels. + − × ÷ and sqrt alone.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <utility>

#include "shared/query/cell_block.h"

namespace scree {

/// `unit` has length 1.
struct Line {
  glm::dvec3 from{0.0};
  glm::dvec3 unit{0.0};

  glm::dvec3 at(double along) const { return from + unit * along; }
};

/// Where something that moves along a line meets a surface.
struct SurfaceHit {
  double along = 0.0;      ///< of the line
  glm::dvec3 place{0.0};   ///< on the surface
  glm::dvec3 normal{0.0};  ///< of length 1
};

/// The part of a line, from 0 to `most`, within a distance of the bounds of a surface; nothing where it
/// passes them by.
std::optional<std::pair<double, double>> line_within(const VoxelBox* bounds, double distance,
                                                     const Line& line, double most);

/// The first polygon that the line crosses within `most` voxels, either way through; the normal is
/// the polygon's, out of the rock. `steps` counts the blocks and polygons that were looked at.
std::optional<SurfaceHit> first_on_line(CellSource& cells, const Line& line, double most, uint32_t& steps);

/// Whether a place is on the rock's side of the polygons. Places on a polygon may have either.
bool is_in_rock(CellSource& cells, glm::dvec3 place, uint32_t& steps);

}  // namespace scree
