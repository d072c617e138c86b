// The blows of a tick in which props take part.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// The hardest of each pair, at least limits::contact_event_min_j, the hardest first, at most
/// limits::contact_events_max. Call after the bodies' step.
std::vector<ContactEvent> contacts_of_props(const World::State& state);

}  // namespace scree
