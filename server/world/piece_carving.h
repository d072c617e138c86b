// Living pieces are carved where they are, and terrain becomes bodies that are kept: those never become
// terrain until they are released. Part of the tick's requests (request_stage.h).
#pragma once

#include "server/work/piece_shares.h"
#include "server/world/prop_requests.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// How many pieces a request made, or as its answer says.
using Outcome = tl::expected<uint32_t, Refused>;

/// Refuses a carve of a piece that is not there, and a pattern that breaks none. The rest is checked as of
/// a carve.
CheckedRequest check_piece_carve(const World::State& state, const CarveRequest& request);
CheckedRequest check(const World::State& state, const ReleaseRequest& request);

/// Cuts the shape out of the piece. What lies in it breaks, and is thrown as a carve's pieces are, beyond its
/// motion as a part of the piece; the rest goes on as it moved, and stays kept if the piece was. Refuses a
/// shape that takes nothing.
Outcome carve_piece(World::State& state, const CarveRequest& request, uint64_t party, const PieceGrant& grant,
                    TickDelta& delta);

/// Makes the terrain in a valid shape one kept piece, or several where it is not connected. Returns the id of
/// the first; the others' follow. 0: all of it was dust.
Outcome cut_out(World::State& state, const CutOutRequest& request, uint64_t party, const PieceGrant& grant,
                TickDelta& delta);

uint32_t perform(World::State& state, const ReleaseRequest& request, uint64_t party, TickDelta& delta);

}  // namespace scree
