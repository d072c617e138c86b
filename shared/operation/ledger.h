// Where the mass of a world is. The simulation checks the sum after every tick, recordings keep it for each
// tick.
#pragma once

#include "shared/field/mass.h"

namespace scree {

/// Mass in all its places, in units of 1/254 voxel. Invariant, at every tick: terrain + pieces + dust =
/// poured.
struct Ledger {
  MassUnits terrain = 0;  ///< gain of the terrain since the start (negative: loss)
  MassUnits pieces = 0;   ///< in pieces alive; not negative
  MassUnits dust = 0;     ///< merges take it up again; not negative
  MassUnits poured = 0;   ///< added by fills
  MassUnits moved = 0;    ///< taken out of the terrain since the start, in all; for scale

  MassUnits error() const { return terrain + pieces + dust - poured; }
  bool operator==(const Ledger&) const = default;
};

}  // namespace scree
