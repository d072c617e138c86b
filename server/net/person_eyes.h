// Where the eye of a session is, in a world whose persons walk: with its person, whatever its client says. On
// the network thread.
#pragma once

#include <glm/vec3.hpp>

#include "server/net/session_table.h"
#include "server/publish/publisher.h"
#include "server/world/service_limits.h"

namespace scree {

/// The eye that a client told, or that of its person on foot, if it is not there.
glm::vec3 believed_eye_m(const PublishedState& world, uint64_t session, glm::vec3 told_m);

/// Puts the session's eye where its person's is, if it has one. Refuses an edit by who has none in a world
/// whose persons walk; directors may.
tl::expected<void, Refused> look_from_person(const PublishedState& world, const ServiceLimits& service,
                                             uint64_t session, const Request& request, SessionEntry& entry);

}  // namespace scree
