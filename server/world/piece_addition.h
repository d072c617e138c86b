// Bodies of voxels that requests bring. Part of the tick's requests (request_stage.h).
#pragma once

#include "server/world/piece_carving.h"

namespace scree {

/// Looks at the head of the volume alone: what is wrong with its voxels is found when its turn comes.
CheckedRequest check(const World::State& state, const AddPieceRequest& request);

/// Makes a piece of each part of the request's voxels, and enters their mass as poured in. Refuses bytes that
/// are no volume, materials that the palette does not have, voxels without rock or in too many parts, and
/// what has no room. Returns the id of the first; the others' follow.
Outcome add_piece(World::State& state, const AddPieceRequest& request, uint64_t party,
                  const PieceGrant& grant, TickDelta& delta);

}  // namespace scree
