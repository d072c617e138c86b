// The planes of flat faces at the corners of a brick's cells, for rays (client/shaders/bricks.glsl).
//
// Cells in which faces meet are marked, by the length of the normal at their lowest corner. A cell is an edge
// when each two of its corners' planes are clearly of one face or clearly of two: round rock, whose normals
// turn from corner to corner, has none. And the planes must leave its corners on their sides of the surface:
// where steps are finer than voxels, they do not, and the rock is drawn rounded there.
#pragma once

#include <memory>

#include "shared/surface/face_plane.h"

namespace scree {

/// Samples 0 … 8 of a brick along each axis.
inline constexpr int corner_brick_side = brick_size + 1;

using PlaneBrick = std::array<FacePlane, corner_brick_side * corner_brick_side * corner_brick_side>;

/// Lengths of the normal at the lowest corner of an edge's cell, of 127: of a known plane, and of no plane.
inline constexpr int edge_normal_length = 95;
inline constexpr int edge_no_normal_length = 32;

/// Voxels beyond these samples that their planes depend on: those of neighbours, too.
inline constexpr int plane_brick_reach = face_plane_reach + 1;

/// The planes of the brick that begins at `first`, if faces meet in it. The window must hold its samples 0 …
/// 8 grown by plane_brick_reach.
std::unique_ptr<PlaneBrick> planes_of(const Window& window, VoxelCoord first);

/// In which eighths of it cells are marked as edges: bit 4x + 2y + z, each 1 in the farther half.
uint32_t edge_eighths(const PlaneBrick& planes);

}  // namespace scree
