// Parts of a well-mixed mass by where they come from. Exact: whole units, and none is lost or made.
#pragma once

#include <vector>

#include "shared/region/region_mass.h"

namespace scree {

struct OriginShare {
  MassOrigin origin;
  MassUnits mass = 0;

  bool operator==(const OriginShare&) const = default;
};
/// In order of origins, each once and more than 0. What else the mass has is of no origin.
using OriginShares = std::vector<OriginShare>;

MassUnits sum_of(const OriginShares& shares);
void add(OriginShares& to, const MassOrigin& origin, MassUnits mass);
void add(OriginShares& to, const OriginShares& more);

/// Takes `part` of a mass of `whole`, both not negative: of each share as much as of the whole, rounded so
/// that what is taken and what is left are whole units, and neither is more than its mass. Shares that are
/// more than the whole, as a file may have them, count as the whole.
OriginShares take_part(OriginShares& from, MassUnits part, MassUnits whole);

/// A mass, and what of it has an origin.
struct MixedMass {
  MassUnits total = 0;
  OriginShares shares;

  void pour(MassUnits mass, const OriginShares& of) {
    total += mass;
    add(shares, of);
  }
  /// There must be as much.
  OriginShares draw(MassUnits mass);
};

}  // namespace scree
