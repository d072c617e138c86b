// Rock from a file, wherever it is from: a volume in the world's voxels.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/base/result.h"
#include "shared/field/brick_materials.h"
#include "shared/field/stored_chunks.h"

namespace scree {

/// The chunks around a box of voxels; an error when they reach beyond the world.
Result<BrickLayout> layout_around(const VoxelBox& box, float voxel_size_m);

/// The chunks that a box of voxels touches.
size_t count_chunks(const VoxelBox& box);

class Solid {
 public:
  virtual ~Solid() = default;

  /// The chunks in which its surface, or the narrow band beside it, lies; in order, none twice.
  virtual std::vector<ChunkCoord> surface_chunks() const = 0;
  /// All of its rock, in voxels.
  virtual VoxelBox box() const = 0;
  /// Height of the lowest rock, metres.
  virtual double lowest_m() const = 0;
  /// Levels at the voxels of the box, z fastest, negative inside: in voxels beside the surface, and farther
  /// away at least of the right sign. As many as the box has voxels.
  virtual void read_levels(const VoxelBox& box, std::span<float> levels) const = 0;
  virtual bool is_inside(VoxelCoord voxel) const = 0;
  /// What its rock in a brick is of, by voxel; ground_own where it does not say. Beside its rock: of no
  /// account.
  virtual BrickMaterials materials(BrickCoord) const { return {}; }
};

}  // namespace scree
