// The numbers that a merge is planned by and sent with.
#pragma once

#include "shared/field/mass.h"

namespace scree {

/// Bounds of a shift, the number by which a merge meets its mass. Each method gives it a meaning of its own;
/// it takes 14 bits on the wire.
inline constexpr int stamp_shift_max = 8191;

/// What the voxels of a merge become: what they were (recordings from before pieces had materials of their
/// own); what the piece is of; or the rubble of that.
enum class Brings : uint8_t { nothing = 0, materials = 1, rubble = 2 };

/// How much of its voxels the terrain's materials fill, and those that a merge brings. A voxel that a merge
/// changes becomes of what it brings where it was not solid, and stays what it was where it was.
struct MergeFills {
  FillWindow were{};
  FillWindow brought{};

  bool are_solid() const { return were.is_solid() && brought.is_solid(); }
  /// Fill of a voxel from that code and occupancy to another occupancy.
  int after(size_t index, Code was, int occupied) const {
    return was < 0 || occupancy(was) == occupied ? were.at(index) : brought.at(index);
  }
};

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
