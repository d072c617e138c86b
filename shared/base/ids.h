// Identifiers that cross module borders.
#pragma once

#include <cstdint>

namespace scree {

/// Number of a simulation step, counted from 1. Also a chunk's version: the tick that changed it last (0:
/// never).
using Tick = uint64_t;

/// A piece of broken terrain. Ids only grow and are never used twice within a world, so a stale id finds
/// nothing.
using PieceId = uint32_t;

}  // namespace scree
