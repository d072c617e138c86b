// Cutting a volume along the planes half-way between seeds. Deterministic; voxels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Voxels along z that are cut, and shared out, at a time.
inline constexpr int cut_width = 8;

/// A row of voxels along z, and the share of each that lies within a part's planes: 0 … 254. Beyond the
/// part's window the shares are 0.
struct SharedRow {
  VoxelCoord first;
  std::array<uint8_t, cut_width> within;
};

/// A part of a volume, and the rows of its window in which it has a share, in the window's order.
struct CellPart {
  Window window;
  std::vector<SharedRow> shares;
};

/// A part that is wanted: what lies within the box, and nearer to one of the own seeds than to any
/// neighbour's. The box lies in the volume's; there is at least one own seed; no two seeds coincide.
struct CellBounds {
  VoxelBox box;
  std::vector<glm::vec3> own;
  std::vector<glm::vec3> neighbours;
};

/// The parts of the volume, in the order of their bounds.
std::vector<CellPart> cut_parts(const Window& volume, const std::vector<CellBounds>& bounds);

}  // namespace scree
