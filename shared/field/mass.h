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
#include "shared/material/material.h"

namespace scree {

/// Units of mass; a full voxel of density 1 has 254.
using MassUnits = int64_t;

inline constexpr int units_per_voxel = 254;

inline constexpr int occupancy(int code) {
  const int ramp = 127 - 6 * code;
  return ramp < 0 ? 0 : (ramp > units_per_voxel ? units_per_voxel : ramp);
}

/// Mass of a voxel of a material that has pores: `fill` 128ths of its occupancy, rounded.
inline constexpr int mass_in_voxel(int occupied, int fill) {
  return (occupied * fill + fill_solid / 2) / fill_solid;
}

/// The fill of the voxels of a window: one for all, or each voxel's own, in the window's order.
struct FillWindow {
  uint8_t all = fill_solid;
  std::vector<uint8_t> each{};

  bool is_solid() const { return each.empty() && all == fill_solid; }
  int at(size_t index) const { return each.empty() ? all : each[index]; }
};

/// Mass of `count` voxels, at most 2^23 of them: the sum then fits an int.
MassUnits mass_of(const Code* codes, size_t count);

/// occupancy(before) − occupancy(after) of each voxel, modulo 256: 0 where the mass stayed.
std::vector<uint8_t> mass_changes(std::span<const Code> before, std::span<const Code> after);

/// The same of voxels that have pores: mass_in_voxel(before) − mass_in_voxel(after), modulo 256.
std::vector<uint8_t> mass_changes(std::span<const Code> before, std::span<const Code> after,
                                  const FillWindow& fills);
/// Mass of a window whose voxels have pores.
MassUnits mass_of(const Window& window, const FillWindow& fills);

inline MassUnits brick_mass(const Brick& brick) {
  return mass_of(brick.codes.data(), brick.codes.size());
}
inline MassUnits mass_of(const Window& window) {
  return mass_of(window.codes.data(), window.codes.size());
}

}  // namespace scree
