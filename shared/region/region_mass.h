// What became of the rock that was broken out of a region which counts (Region::counts). A plain value, in
// units of 1/254 voxel.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "shared/field/mass.h"
#include "shared/region/region.h"

namespace scree {

/// Where mass comes from: the region whose terrain it was, and the party that broke it out (command.h).
struct MassOrigin {
  RegionId region = 0;
  uint64_t party = 0;  ///< 0: the world itself, and parties beyond limits::origins_max

  auto operator<=>(const MassOrigin&) const = default;
};

/// The mass of one material and origin. Invariant: what was cut is the sum of the rest.
struct RegionMass {
  MassOrigin origin;
  Material material{};
  MassUnits cut = 0;      ///< out of the region's terrain, since it counts
  MassUnits pieces = 0;   ///< of that, in pieces alive
  MassUnits dust = 0;     ///< as dust
  MassUnits carried = 0;  ///< in stores
  MassUnits back = 0;     ///< terrain in the region again
  MassUnits away = 0;     ///< terrain elsewhere

  MassUnits error() const { return cut - pieces - dust - carried - back - away; }
  bool operator==(const RegionMass&) const = default;
};

}  // namespace scree
