// What the unedited ground weighs where a world's terrain is edited: kept with each chunk
// (server/formats/world.proto), so that a start balances the ledger without generating the ground. Pure
// functions of the ground.
#pragma once

#include <array>
#include <span>

#include "proto/messages.h"
#include "server/world/world.h"
#include "shared/field/mass.h"

namespace scree {

/// By index_in_chunk(). A brick weighs at most 512 · 254 units.
using MassByBrick = std::array<int32_t, chunk_bricks * chunk_bricks * chunk_bricks>;

/// The masses of every brick of a chunk. Generates it.
MassByBrick ground_masses(const TerrainSource& ground, ChunkCoord chunk);

/// The masses of these bricks, by chunk. Generates each chunk. Bricks of a chunk may come in any order, each
/// once.
GroundMasses measured_ground(const TerrainSource& ground, std::span<const BrickPatch> bricks);

}  // namespace scree
