// Stones where pieces merged, as rows of a world's file (world.proto, Stone).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/result.h"
#include "shared/recombine/settled_stone.h"

namespace scree {

std::vector<uint8_t> encode(const SettledStone& stone);
/// Refuses what no stone has.
Result<SettledStone> decode_stone(std::span<const uint8_t> bytes);

}  // namespace scree
