// Triangles of the field's surface, ready for the GPU: the result of surface_nets and marching_cubes. Units:
// voxels.
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
inline constexpr int surface_steps = 256;
inline constexpr float surface_steps_per_voxel = surface_steps;

/// Longest side of an owned box, voxels: positions must fit 16 bits.
inline constexpr int surface_side_max = 250;

/// Ready to be uploaded: 12 bytes.
struct SurfaceVertex {
  std::array<uint16_t, 3> position{};  ///< 1/256 voxel, from the mesh's origin
  uint8_t openness = 255;              ///< 255: the field is open above; less: a crevice
  Code before = 0;                     ///< code of the `before` window here; 0 without one
  std::array<int8_t, 3> normal{};      ///< the field's gradient, out of the rock; unit length is 127
  uint8_t look = 0;                    ///< for the drawing side (client/render/levels/look_window.h)

  bool operator==(const SurfaceVertex&) const = default;
};
static_assert(sizeof(SurfaceVertex) == 12);

struct SurfaceMesh {
  VoxelCoord origin;                    ///< voxel of position (0, 0, 0)
  std::vector<SurfaceVertex> vertices;  ///< each once
  std::vector<float> slopes;      ///< of the field at each vertex: 1 on flat faces, less where faces meet
  std::vector<uint32_t> indices;  ///< triangles, counter-clockwise seen from the air

  bool empty() const { return indices.empty(); }
};

}  // namespace scree
