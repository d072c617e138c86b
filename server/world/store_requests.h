// What clients ask of stores: terrain and pieces are dug into them and placed out of them, and mass goes from
// one to another. Refusals that no wait could mend are those of check().
#pragma once

#include "server/world/prop_requests.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

CheckedRequest check(const World::State& state, const DigRequest& request);
CheckedRequest check(const World::State& state, const PlaceRequest& request);
CheckedRequest check(const World::State& state, const TransferRequest& request);

/// Carries out a request that has passed check() now, or refuses it and changes nothing; notes its mass
/// (World::State::request_mass). Returns how many pieces were taken in.
Performed perform(World::State& state, const DigRequest& request, uint64_t party, TickDelta& delta);
Performed perform(World::State& state, const PlaceRequest& request, uint64_t party, TickDelta& delta);
Performed perform(World::State& state, const TransferRequest& request, uint64_t party, TickDelta& delta);

/// The operations of requests, for what all edits are asked.
DigOperation operation_of(const DigRequest& request);
PlaceOperation operation_of(const World::State& state, const PlaceRequest& request);

/// The session cannot go on: what its store has goes to the world's.
void give_up_store(World::State& state, uint64_t session);

/// Takes the stores of a kept world. Refuses what does not agree with its ledger.
Result<void> restore_stores(World::State& state, const std::vector<StoreRecord>& records);

}  // namespace scree
