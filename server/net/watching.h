// What of cursors and physics concerns one client: pure selection.
#pragma once

#include <glm/vec3.hpp>
#include <map>

#include "proto/messages.h"
#include "server/world/published_state.h"

namespace scree {

/// The cursors of all others whose eye or aim lies within the radius; at most limits::cursors_max.
std::vector<PlayerCursor> cursors_for(uint64_t session, const std::map<uint64_t, PlayerCursor>& cursors,
                                      glm::vec3 eye_m, float radius_m);

/// What lies within the radius, at most as much as a message holds. `state` says where the pieces are.
PhysicsMessage physics_for(const PhysicsMessage& physics, const PublishedState& state, float voxel_size_m,
                           glm::vec3 eye_m, float radius_m);

}  // namespace scree
