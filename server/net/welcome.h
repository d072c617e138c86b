// What a client is granted when it joins: the protocol, the radius of interest, and a welcome.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "proto/messages.h"
#include "server/command/refusal.h"
#include "server/net/net_server.h"
#include "shared/base/result.h"

namespace scree {

/// Refuses a client that does not speak the server's protocol. The reason names the numbers of both.
tl::expected<void, Refused> find_protocol(const HelloMessage& hello);

/// The hello of a client that speaks the server's protocol, as find_protocol() says. The eye is at the spawn
/// where the client has no place of its own and there is a spawn.
tl::expected<HelloMessage, Refused> placed(HelloMessage hello, const std::optional<Spawn>& spawn);

/// The radius of interest that a client gets, metres: at most limits::interest_radius_max_m. Refuses a place
/// or a radius that is no number, and a negative radius.
Result<float> granted_radius(glm::vec3 eye_m, float radius_m);

/// A welcome without the session's own part: number, tick, interest, role, ticket. `world`: as of
/// WelcomeMessage. The publisher knows spawn and palette.
WelcomeMessage welcome_of(const NetConfig& config, uint64_t world, const Publisher& publisher);

}  // namespace scree
