// Which region counts the terrain of a voxel: the first one of those that count (Region::counts) in which its
// place lies. Plain values. 0: none does.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "shared/field/brick.h"
#include "shared/field/coord.h"
#include "shared/region/region.h"

namespace scree {

/// The regions of a brick's voxels, in its order; nothing where none counts any.
using BrickZones = std::optional<std::array<RegionId, brick_voxels>>;

class RegionZones {
 public:
  RegionZones(const std::vector<Region>& regions, float voxel_size_m);

  bool empty() const { return counting_.empty(); }
  /// Whether one may count voxels of the box.
  bool meet(const VoxelBox& box) const;
  BrickZones of(BrickCoord brick) const;
  bool counts(RegionId region) const;
  const std::vector<Region>& regions() const { return counting_; }
  bool operator==(const RegionZones&) const = default;

 private:
  glm::vec3 place_of(VoxelCoord voxel) const;

  std::vector<Region> counting_;
  float voxel_size_m_;
};

}  // namespace scree
