// Joints as part of a world: requests that add, change and remove them, and how they end by themselves.
// Refusals that no wait could mend are those of check().
#pragma once

#include "server/command/refusal.h"
#include "server/world/prop_requests.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

CheckedRequest check(const World::State& state, const AddJointRequest& request);
CheckedRequest check(const World::State& state, const RemoveJointRequest& request);
CheckedRequest check(const World::State& state, const SetMotorRequest& request);

/// Carries out a request that has passed check() now. Returns the id of the joint that was added, else 0.
uint32_t perform(World::State& state, const AddJointRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const RemoveJointRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const SetMotorRequest& request, uint64_t party, TickDelta& delta);

/// Takes out the joints that ended in this tick: those that broke, whose bodies are gone, and whose place in
/// the terrain is rock no more. To be called when the tick has changed all that it changes.
void end_joints(World::State& state, TickDelta& delta);

/// Enters the joints of a kept world, which are for its bodies to take. Bodies must be entered before.
/// Refuses ids that are none yet, or somebody else's.
Result<std::vector<KnownJoint>> restore_joints(World::State& state, const std::vector<JointRecord>& records);
/// Takes out the joints whose bodies are not among these.
void drop_joints_without(const std::vector<BodyMotion>& bodies, std::vector<JointRecord>& records);

}  // namespace scree
