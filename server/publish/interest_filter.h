// Selects the cursors and the physics within one client's interest.
#pragma once

#include <glm/vec3.hpp>
#include <map>

#include "proto/messages.h"
#include "server/world/published_state.h"

namespace scree {

/// The cursors of all others whose eye or aim lies within the radius; at most limits::cursors_max.
std::vector<PlayerCursor> cursors_for(uint64_t session, const std::map<uint64_t, PlayerCursor>& cursors,
                                      glm::vec3 eye_m, float radius_m);

/// The bodies, contacts and bricks within the radius, up to the limits of a message (proto/limits.h). `state`
/// has the pieces' poses.
PhysicsMessage physics_for(const PhysicsMessage& physics, const PublishedState& state, float voxel_size_m,
                           glm::vec3 eye_m, float radius_m);

}  // namespace scree
