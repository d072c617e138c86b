// Bounds of regions. Each says its unit, its reason, and what happens at the bound.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Regions of one world: each edit is compared with all of them, and each client gets all of them, some 64
/// KiB at most. Above: refused.
inline constexpr size_t regions_max = 256;

/// Length of a region's name, bytes. Above: refused.
inline constexpr size_t region_name_bytes_max = 32;

/// Persons who may edit in one region, by name. Above: refused.
inline constexpr size_t region_persons_max = 8;

/// Half of a region's longest side, and of its shortest one, metres: a town, and a door. Beyond: refused.
inline constexpr float region_half_max_m = 512.0F;
inline constexpr float region_half_min_m = 0.1F;

/// How long a region may last by its request, seconds: a year. Above: refused; 0: until it is removed.
inline constexpr float region_lasts_max_s = 3.2e7F;

}  // namespace scree::limits
