// Surface nets: triangles of the zero level of a window of codes (Gibson 1998), for the eye, and for cutters
// and slices, which work on polygons (polygon_mesh.h, stamp_slices.h): deterministic.
//
// A cell is the cube between 8 voxels; each sheet of surface in it gets one vertex, at the mean of the
// crossings of its edges, and each grid edge that the surface crosses gets one quad. Where a cell holds
// several sheets it gets several vertices (Nielson 2004, "Dual Marching Cubes"; Wenger 2013, 3.4, for the
// faces that two cells would pinch), so every edge of the whole surface is shared by exactly two triangles.
//
// Seams: a box owns the quads of the grid edges whose lower voxel lies in it. Neighbouring boxes compute the
// vertices of shared cells from the same codes, bit for bit, so their meshes meet without a crack.
// Pure, safe from any thread. Units: voxels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Voxels that the window must reach beyond the owned box on every side: the crossings need one, the
/// gradients two, the probe for openness four.
inline constexpr int surface_nets_apron = 4;

/// Positions are multiples of 1/256 voxel.
inline constexpr float surface_steps_per_voxel = 256.0F;

/// Longest side of an owned box, voxels: positions must fit 16 bits.
inline constexpr int surface_side_max = 250;

/// Ready to be uploaded: 12 bytes.
struct SurfaceVertex {
  std::array<uint16_t, 3> position{};  ///< 1/256 voxel, from the mesh's origin
  uint8_t openness = 255;              ///< 255: the field is open above; less: a crevice
  Code before = 0;                     ///< code of the `before` window here; 0 without one
  std::array<int8_t, 3> normal{};      ///< the field's gradient, out of the rock; unit length is 127
  int8_t padding = 0;

  bool operator==(const SurfaceVertex&) const = default;
};
static_assert(sizeof(SurfaceVertex) == 12);

struct SurfaceMesh {
  VoxelCoord origin;                    ///< voxel of position (0, 0, 0)
  std::vector<SurfaceVertex> vertices;  ///< each once
  std::vector<uint32_t> indices;        ///< triangles, counter-clockwise seen from the air

  bool empty() const { return indices.empty(); }
};

/// Meshes `owned`; `window` must cover owned.grown(surface_nets_apron). `before`, if given, has the window's
/// box: what the field was as generated, so that fresh surfaces can be told from weathered ones.
SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before = nullptr);

/// Meshes a window outside of which all is air: a piece's volume.
SurfaceMesh surface_nets_closed(const Window& volume, const Window* before = nullptr);

}  // namespace scree
