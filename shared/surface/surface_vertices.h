// The vertices of a surface, computed eight at a time: their places in their cells, normals and openness.
// Pure, safe from any thread; a vertex depends only on the codes around its cell, not on its batch.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/surface/surface_mesh.h"

namespace scree {

/// The vertex of one sheet of surface in a cell.
struct CrossedSheet {
  int32_t cell = 0;             ///< index of the cell's lowest voxel in the window
  uint16_t edges = 0;           ///< bit e: the sheet crosses edge e (surface_cells.h); at least one
  std::array<uint8_t, 3> at{};  ///< the cell, from the mesh's origin
};

/// A vertex whose place is known.
struct PlacedVertex {
  int32_t cell = 0;
  std::array<uint16_t, 3> position{};  ///< 1/256 voxel from the mesh's origin, for the vertex
  glm::vec3 fraction{0.0F};            ///< from the cell's lowest voxel, 0..1
};

/// Appends one vertex for each sheet, at the mean of the crossings of its edges (Gibson 1998), strictly
/// inside the cell. `window` reaches far enough beyond the cells (surface_nets_apron); `before` has its box.
/// The mesh gets their slopes, too.
void add_sheet_vertices(const Window& window, const Window* before, std::span<const CrossedSheet> sheets,
                        SurfaceMesh& mesh);
/// Appends a vertex at each place, under the same conditions.
void add_placed_vertices(const Window& window, const Window* before, std::span<const PlacedVertex> placed,
                         SurfaceMesh& mesh);

}  // namespace scree
