// What clients ask of props and of single bodies: props are added, moved and removed, bodies pushed, pieces
// broken where they are. Refusals that no wait could mend are those of check().
#pragma once

#include <string>

#include "server/command/refusal.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// Enters an event of a prop that is there: that it was added, or is about to be removed.
void tell_of_prop(const World::State& state, EventKind kind, PieceId id, TickDelta& delta);

using CheckedRequest = tl::expected<void, Refused>;

/// Refuses a place outside the world, and what is no rotation; `body` is the word for what it is of.
CheckedRequest check_place(glm::vec3 place_m, Refusal reason, const std::string& body);
CheckedRequest check_turn(const glm::quat& turn, Refusal reason, const std::string& body);

CheckedRequest check(const World::State& state, const AddPropRequest& request);
CheckedRequest check(const World::State& state, const RemovePropRequest& request);
CheckedRequest check(const World::State& state, const MovePropRequest& request);
CheckedRequest check(const World::State& state, const PushRequest& request);
CheckedRequest check(const World::State& state, const BreakRequest& request);
CheckedRequest check(const World::State& state, const BlastRequest& request);

/// Carries out a request that has passed check() now. Returns the id of the prop that was added, or into how
/// many pieces one broke: 0 where it is too small, or where there is no room; else 0. Refuses a prop whose
/// hulls have no volume: that costs too much to find out before.
using Performed = tl::expected<uint32_t, Refused>;

Performed perform(World::State& state, const AddPropRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const RemovePropRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const MovePropRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const PushRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const BreakRequest& request, uint64_t party, TickDelta& delta);

}  // namespace scree
