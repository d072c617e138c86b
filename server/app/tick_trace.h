// A tick of the server in a trace.
#pragma once

#include "server/world/tick_delta.h"
#include "shared/base/trace.h"

namespace scree {

/// The tick's stages, one after the other from `begin` on the track of the simulation, and how many pieces it
/// left.
void trace_tick(Trace& trace, Trace::Clock::time_point begin, const TickDelta& delta);

}  // namespace scree
