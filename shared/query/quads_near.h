// Every polygon of a surface with places in a box, once. Units: voxels.
#pragma once

#include <bit>
#include <glm/vec3.hpp>

#include "shared/query/cell_block.h"
#include "shared/query/vectors.h"

namespace scree {

/// Voxels to whose edges the quads belong that may have places in a box.
inline VoxelBox owners_of_quads_in(const glm::dvec3& lo, const glm::dvec3& hi) {
  return {{floor_to_int(lo.x), floor_to_int(lo.y), floor_to_int(lo.z)},
          {floor_to_int(hi.x) + 2, floor_to_int(hi.y) + 2, floor_to_int(hi.z) + 2}};
}

/// Half a diagonal of what the quads of a block, and of a cell, may reach around its middle.
inline constexpr double block_reach = 8.67;
inline constexpr double cell_reach = 2.6;

/// Calls each(quad) for the crossed edges from voxels in `owners` and not in `done`, x slowest, where
/// is_near(middle, reach) is true of the block and then of the cell. False from `each` ends it. `steps`
/// counts the blocks and quads.
template <typename IsNear, typename Each>
void for_each_quad(CellSource& cells, VoxelBox owners, const VoxelBox& done, uint32_t& steps,
                   IsNear&& is_near, Each&& each) {
  if (const VoxelBox* bounds = cells.bounds()) {
    if (bounds->empty()) return;
    owners = common(owners, bounds->grown(1));
  }
  if (owners.empty()) return;
  const BrickCoord a = brick_of(owners.lo), b = brick_of(owners.hi - VoxelCoord{1, 1, 1});
  for (int bx = a.x; bx <= b.x; ++bx)
    for (int by = a.y; by <= b.y; ++by)
      for (int bz = a.z; bz <= b.z; ++bz) {
        const VoxelCoord first = first_voxel(BrickCoord{bx, by, bz});
        const VoxelBox whole{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
        if (!done.empty() && done.covers(common(whole, owners))) continue;
        if (!is_near(glm::dvec3(first.x, first.y, first.z) + 4.0, block_reach)) continue;
        ++steps;
        const CellBlock* block = cells.block({bx, by, bz});
        if (block == nullptr) continue;
        for (int x = 0; x < brick_size; ++x)
          for (uint64_t left = block->active()[static_cast<size_t>(x)]; left != 0; left &= left - 1) {
            const int bit = std::countr_zero(left);
            const VoxelCoord in{x, bit >> 3, bit & 7}, voxel = first + in;
            if (!owners.holds(voxel) || done.holds(voxel)) continue;
            if (!is_near(glm::dvec3(voxel.x, voxel.y, voxel.z), cell_reach)) continue;
            for (int axis = 0; axis < 3; ++axis) {
              if (!block->is_crossed(in, axis)) continue;
              ++steps;
              if (!each(block->quad(in, axis))) return;
            }
          }
      }
}

}  // namespace scree
