// Bounds of stores. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Bytes of the name that a game gives to a store. Above, or none: refused.
inline constexpr size_t store_name_bytes_max = 32;

/// Stores of a world: one for each of as many persons as a server may have, and some hundred of the game's.
/// Above: who has none cannot dig until others are empty.
inline constexpr size_t stores_max = 4608;

/// Stores in one message: of 255 materials each, it stays below 1 MiB. Above: the rest is left out.
inline constexpr size_t stores_a_message = 256;

/// Digging a second, m³, that a server may be asked for: more than any machine carves. Above: refused where a
/// world is created.
inline constexpr uint32_t dig_max_m3_per_s = 100000;

/// Rock that a person's store may be asked to hold, m³: a hill of 500 m. Above: refused where a world is
/// created.
inline constexpr uint32_t store_max_m3 = 100'000'000;

}  // namespace scree::limits
