// What clients ask of persons on foot: they enter the world, walk, and leave. An input is taken at once, and
// carried out by the stage `persons`, one for each tick that has passed; the rest waits for its turn.
#pragma once

#include "server/world/prop_requests.h"

namespace scree {

/// Whether the body is that of a person on foot.
bool is_body_of_person(const World::State& state, PieceId id);
/// Refuses to change the body of a person; what else is wrong with it is for others to say.
CheckedRequest check_is_no_person(const World::State& state, PieceId id);

CheckedRequest check(const World::State& state, const StandRequest& request, uint64_t session);
/// Returns the id of the body.
uint32_t perform(World::State& state, const StandRequest& request, uint64_t session, uint64_t party,
                 TickDelta& delta);

/// Queues an input behind the person's others.
CheckedRequest take_input(World::State& state, const WalkRequest& request, uint64_t session, uint32_t number);

/// Takes the session's person out of the world, if there is one.
void leave_on_foot(World::State& state, uint64_t session, TickDelta& delta);
/// The same of all.
void leave_on_foot(World::State& state, TickDelta& delta);

/// Whether a world can have such a person, but for the body.
bool is_person(const PersonRecord& person);

/// Takes the persons of a world's value; the props are there. An error says what a world cannot have.
Result<void> restore_persons(World::State& state, const WorldMoment& moment);

/// Refuses an edit that is not in sight of the command's eye: terrain lies between that and the edit.
CheckedRequest check_sight(World::State& state, const Command& command);

}  // namespace scree
