// Pieces that are still to be cut. A carve into more pieces than are made at once (pieces_at_once) makes
// fewer, larger ones. The next ticks cut these on, as far as their budgets go, by shatters where the pieces
// are then.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Enters the pieces of a party's carve that asked for `wanted` pieces: each is to be cut into its share, by
/// mass. `whole`: there is one, which the blow has not thrown yet.
void queue_refractures(World::State& state, const Applied& applied, const CarveRequest& request,
                       uint64_t party, uint32_t wanted, bool whole);

/// Enters one that waits already.
void enter_refracture(World::State& state, const PendingRefracture& pending);

/// Cuts waiting pieces, by the parties' turns and each party's in order: as many as the tick's budget allows,
/// and now and then one that it does not. Pieces that are gone need no cut any more; where there is no room
/// for more pieces (WorldConfig::pieces_max) they stay whole.
void refracture_pieces(World::State& state, TickDelta& delta);

}  // namespace scree
