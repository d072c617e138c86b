// The regions of a world, as clients get them.
#pragma once

#include <string>
#include <vector>

#include "shared/region/region.h"
#include "shared/region/region_mass.h"

namespace scree {

/// All regions of the world, ordered by id.
struct RegionsMessage {
  std::vector<Region> regions;  ///< at most limits::regions_max
};

/// What became of the rock of regions that count.
struct ListRegionMassesRequest {
  std::string region;  ///< the name of one; empty: all
};

}  // namespace scree
