// How many pieces a request may make, and what it costs with these. Part of the tick's requests
// (request_stage.h).
#pragma once

#include <optional>

#include "server/command/refusal.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// The refusal of a carve without room, which says what would help: fewer seeds, more room, or time, if the
/// carve ever fits.
Refused no_room(const World::State& state, uint32_t seeds, uint64_t party, const PieceGrant& grant);

/// As the carve that a request is, or that its blast is at most in voxels of that size; nothing: it makes no
/// pieces.
std::optional<CarveRequest> carve_in(const Request& request, float voxel_size_m);

/// Whether terrain may fall because of it.
bool may_loosen(const Request& request);

/// The pieces that a request may make.
PieceGrant grant_for(const World::State& state, const Command& command);

/// Price of the request with the pieces that it was granted. Pieces that are cut later are in it, so that
/// their client pays for them, too.
float cost_with(const World::State& state, const WaitingRequest& request, const PieceGrant& grant);

/// Whether the request waits for room that may come.
bool may_wait(const World::State& state, const WaitingRequest& request, const PieceGrant& grant);

/// Time in the tick that is kept for pieces at rest that could not merge in the last one.
float relief_us(const World::State& state);

/// Whether a tick's first request that costs time may be carried out, though it may not fit: at any time with
/// few bodies, now and then with many.
bool may_begin(const World::State& state, float cost_us);

}  // namespace scree
