// Places where blows struck that were too weak for a dent: what several of them press in at one place adds up
// until it is one. Part of the world's state. Deterministic. Not thread-safe.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "server/formats/world_value.h"

namespace scree {

class StruckPlaces {
 public:
  /// Adds a blow's energy at a voxel, and returns the sum there. The place that was struck least lately is
  /// forgotten where there are more than limits::struck_places_max.
  float add(VoxelCoord voxel, float energy_j, Tick now);
  /// Terrain changed: what these bricks, which are in order, suffered before no longer counts.
  void forget(std::span<const BrickCoord> changed);

  std::vector<StruckPlace> value() const;
  /// Goes on with these, of which no two have the same cell.
  void restore(const std::vector<StruckPlace>& value);

 private:
  struct Suffered {
    float energy_j = 0.0F;
    Tick at = 0;
  };
  std::map<VoxelCoord, Suffered> cells_;
};

}  // namespace scree
