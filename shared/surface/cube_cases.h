// The triangles of marching cubes (Lorensen and Cline 1987), by the signs of a cell's 8 corners, for the CPU
// (marching_cubes.h) and for the shader of the method grid. The table is computed from the loops of
// leaf_loops.h, which separate rock that meets across a face by two corners alone, so that neighbouring cells
// agree on every face.
//
// Corners and edges are numbered as in surface_cells.h. No diagonal of a loop lies in a face of the cell,
// where the neighbour might have the same one: every edge of the whole surface is shared by exactly two
// triangles.
#pragma once

#include <array>
#include <cstdint>

namespace scree {

inline constexpr int cube_triangles_max = 5;

struct CubeCase {
  uint8_t triangles = 0;
  /// Edges of the cell that a triangle's corners lie on, counter-clockwise seen from the air.
  std::array<uint8_t, 3 * cube_triangles_max> edges{};
};

/// Case index: bit i set when corner i is rock.
const std::array<CubeCase, 256>& cube_cases();

}  // namespace scree
