// Mass in integer units, so that the ledger is exact by construction.
//
// A voxel holds 254 units when inside, none outside, and a ramp of one voxel's width across the surface:
// occupancy(c) = clamp(127 − 6c, 0, 254), which is 254 · clamp(½ − d) for the distance d = 3c/127 voxels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Units of mass; a full voxel of density 1 has 254.
using MassUnits = int64_t;

inline constexpr int units_per_voxel = 254;

inline constexpr int occupancy(int code) {
  const int ramp = 127 - 6 * code;
  return ramp < 0 ? 0 : (ramp > units_per_voxel ? units_per_voxel : ramp);
}

/// Mass of `count` voxels, at most 2^23 of them: the sum then fits an int.
MassUnits mass_of(const Code* codes, size_t count);

/// occupancy(before) − occupancy(after) of each voxel, modulo 256: 0 where the mass stayed.
std::vector<uint8_t> mass_changes(std::span<const Code> before, std::span<const Code> after);

inline MassUnits brick_mass(const Brick& brick) {
  return mass_of(brick.codes.data(), brick.codes.size());
}
inline MassUnits mass_of(const Window& window) {
  return mass_of(window.codes.data(), window.codes.size());
}

}  // namespace scree
