// Bounds of props. Each says its unit, its reason, and what happens at the bound.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Parts of one prop, and corners of a part that is a hull: a step compares each with each of a neighbour's.
/// Above: refused.
inline constexpr size_t prop_parts_max = 16;
inline constexpr size_t prop_corners_max = 64;

/// Half of a side, and the distance of any point from the prop's origin, metres. Thinner ones pass between
/// the places where terrain is compared; larger ones touch hundreds of pieces at once. Beyond: refused.
inline constexpr float prop_half_min_m = 0.01F;
inline constexpr float prop_reach_max_m = 16.0F;

/// Mass of a prop, kg. A solver of eight steps bears a ratio of masses of some thousands. Beyond: refused.
inline constexpr float prop_mass_min_kg = 0.01F;
inline constexpr float prop_mass_max_kg = 1e7F;

/// Coefficient of friction at most, and gravity's share either way. Above: refused.
inline constexpr float prop_friction_max = 4.0F;
inline constexpr float prop_gravity_max = 4.0F;

/// Bytes that a game may give a prop. Above: refused.
inline constexpr size_t prop_data_bytes_max = 256;

}  // namespace scree::limits
