// The numbers that a merge is planned by and sent with.
#pragma once

#include "shared/field/mass.h"

namespace scree {

/// Bounds of a shift, the number by which a merge meets its mass. Each method gives it a meaning of its own;
/// it takes 14 bits on the wire.
inline constexpr int stamp_shift_max = 8191;

struct StampPlan {
  int shift = 0;
  MassUnits gain = 0;  ///< mass that the window gains with that shift
};

/// Mass that a merge may gain: the piece's, and of the waiting dust at most a thirty-second of that, as a
/// piece that takes much more bulges (measured: bench seams).
inline MassUnits stamp_budget(MassUnits piece_mass, MassUnits dust) {
  const MassUnits most = piece_mass / 32;
  return piece_mass + (dust < most ? dust : most);
}

}  // namespace scree
