// Selects the cursors and the physics within one client's interest.
#pragma once

#include <glm/vec3.hpp>
#include <map>

#include "proto/messages.h"
#include "server/world/published_state.h"

namespace scree {

/// A person's cursor, and the party that he belongs to.
struct PartyCursor {
  PlayerCursor cursor;
  uint64_t party = 0;
};

/// The cursors of all others whose eye or aim lies within the radius, by session; at most
/// limits::cursors_max. Above: the nearest of each party, then the second of each, and so on, so that nobody
/// hides the others by being many.
std::vector<PlayerCursor> cursors_for(uint64_t session, const std::map<uint64_t, PartyCursor>& cursors,
                                      glm::vec3 eye_m, float radius_m);

/// The bodies, contacts and bricks within the radius, up to the limits of a message (proto/limits.h). `state`
/// has the pieces' poses.
PhysicsMessage physics_for(const PhysicsMessage& physics, const PublishedState& state, float voxel_size_m,
                           glm::vec3 eye_m, float radius_m);

}  // namespace scree
