// What the voxels of a box look like, as methods draw it: the looks of the ground, weathered, broken or
// piled, or those of a row of the palette.
//
// A surface looks as the nearest solid voxel beneath it. Where a voxel says nothing of its material, it looks
// as the ground does; but soil and ice under the ground's surface show where a cut lays them bare. What is of
// the ground's bulk always looks as the ground does.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree {

/// 0: as the ground; else 1 + a row of the palette.
struct Look {
  uint8_t shown = 0;  ///< on the ground as it was, and on what was added
  uint8_t bare = 0;   ///< where a cut lays it bare

  bool operator==(const Look&) const = default;
};

/// A code of the field as generated: from here on, looks are those of a cut (client/shaders/bricks.glsl).
inline constexpr Code cut_begins = -10;

struct LookWindow {
  VoxelBox box;
  std::vector<Look> each;  ///< in a window's order; empty: all look as the ground does

  bool is_ground() const { return each.empty(); }
  Look at(VoxelCoord voxel) const;
  size_t index(VoxelCoord voxel) const;  ///< in `each`
};

/// The solid voxel of the cell around a place that is the nearest to a point half a voxel beneath it, against
/// the slope in that cell. `p` in voxels, in the window.
VoxelCoord beneath(const Window& now, glm::vec3 p);

/// The looks of a box of samples of that level, which `ground` generates: on level 0 the field itself.
LookWindow gather_looks(const Field& field, const Field& ground, int level, const VoxelBox& box);

/// A thin layer that came to lie on the ground, such as the foot of a heap, fills no voxel in places, so none
/// has its material there. The ground beneath takes the looks of the layer beside it where the surface has
/// risen, in the voxels that are asked for: one voxel less than the box on each side, or fewer. The windows,
/// now and as generated, have the box of the looks.
void spread_heaps(const Window& now, const Window& before, const VoxelBox& asked, LookWindow& looks);

/// A piece's looks, over its volume's box. `field` knows what the ground was where the piece is from.
LookWindow looks_of(const Field& field, const Volume& piece);

/// Whether the ground stores materials in one of the chunks that the box touches.
bool stores_materials(const Field& ground, const VoxelBox& box);

}  // namespace scree
