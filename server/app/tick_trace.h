// A tick of the server in a trace.
#pragma once

#include "server/world/tick_delta.h"
#include "shared/base/trace.h"

namespace scree {

/// Adds the tick's stages, one after the other from `begin`, to the simulation's track, and the number of
/// pieces.
void trace_tick(Trace& trace, Trace::Clock::time_point begin, const TickDelta& delta);

}  // namespace scree
