// What settings change of a world that goes on.
#pragma once

#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// Sets the values, which set_all() must accept, and tells them in the delta.
void change_settings(World::State& state, const SettingsRequest& request, TickDelta& delta);

}  // namespace scree
