// Pieces that are still to be cut. A carve into more pieces than are made at once (pieces_at_once) makes
// fewer, larger ones. The next ticks cut these on, as far as their budgets go, by shatters where the pieces
// are then.
#pragma once

#include "server/world/blast.h"
#include "server/world/world_state.h"

namespace scree {

/// Makes a break's pattern and seeds, as many as are made at once, those of its first stage of several. A
/// pattern whose cells are cut on gets a few cells about the blow, each of which breaks by the pattern later.
void begin_in_stages(SeedPattern& pattern, uint32_t& seeds, uint32_t wanted);

/// Enters the pieces of a party's carve that asked for `wanted` pieces: each is to be cut into its share, by
/// the seeds that the pattern would have in it if all were cut at once. `whole`: there is one, which the blow
/// has not thrown yet.
void queue_refractures(World::State& state, const Applied& applied, const CarveRequest& request,
                       BlowSide side, uint64_t party, uint32_t wanted, bool whole);

/// Enters one that waits already.
void enter_refracture(World::State& state, const PendingRefracture& pending);

/// Cuts waiting pieces, by the parties' turns and each party's in order: as many as the tick's budget allows,
/// and now and then one that it does not. Pieces that are gone need no cut any more; where there is no room
/// for more pieces (WorldConfig::pieces_max) they stay whole.
void refracture_pieces(World::State& state, TickDelta& delta);

}  // namespace scree
