// The blows of a tick in which bodies take part.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Those that are over (contact_sums.h), the hardest contact of each pair, of at least
/// limits::contact_event_min_j, the hardest first, at most limits::contact_events_max. Those without a prop
/// change a speed by limits::impact_speed_min_m_s, and are at most limits::contact_events_of_rock_max. Call
/// after the bodies' step.
std::vector<ContactEvent> contacts_of_bodies(World::State& state);

}  // namespace scree
