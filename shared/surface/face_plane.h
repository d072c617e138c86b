// The flat faces of the rock as planes at lattice points, so that drawing keeps edges sharp. Near an edge the
// trilinear value between codes is rounded, but each code is exact: it is the distance to the nearest face,
// and the codes beside it say which way that face lies. The planes of a cell's corners therefore continue
// flat faces up to the edge where they meet, as posed_piece.h reads pieces.
//
// Where rock is convex the surface is where the largest of the planes' distances is 0, where it is hollow
// where the smallest is. Measured on cubes, stairs, window reveals and wedges of 30 to 90 degrees, turned at
// random: 95 of 100 places of an edge are within 0.1 voxel (trilinear: 0.45 to 1.9 voxels).
//
// Pure, safe from any thread. Units: voxels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/field/window.h"

namespace scree {

/// Voxels around a lattice point that its plane needs.
inline constexpr int face_plane_reach = 2;
/// Corners of a cell belong to two faces when the cosine of their normals' angle is below this: 20 degrees.
inline constexpr float face_edge_cosine = 0.94F;

/// The plane of the face nearest to a lattice point: normal · (x − point) + distance = 0. As the atlas of the
/// GPU holds it.
struct FacePlane {
  std::array<int8_t, 3> normal{};  ///< out of the rock; unit length is 127; all 0: no flat face is near
  Code code = code_air;            ///< of the distance at the point

  bool is_known() const { return (normal[0] | normal[1] | normal[2]) != 0; }
  glm::vec3 direction() const { return glm::vec3(normal[0], normal[1], normal[2]) * (1.0F / 127.0F); }
  bool operator==(const FacePlane&) const = default;
};
static_assert(sizeof(FacePlane) == 4);

/// The slopes are taken on the side of the point on which the codes bend less. The plane is known when they
/// are as steep as a distance is, and 10 of the 26 points around lie on it. The window must hold the point
/// grown by face_plane_reach.
FacePlane face_plane_at(const Window& window, VoxelCoord point);
/// The same of a point within codes that lie so far apart along x and y, and side by side along z.
FacePlane face_plane_at(const Code* point, std::ptrdiff_t step_x, std::ptrdiff_t step_y);

}  // namespace scree
