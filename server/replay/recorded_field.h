// The terrain of a recording at a tick, as a field of its own. Nothing is simulated. One thread at a time.
#pragma once

#include <memory>
#include <string>

#include "server/replay/replay_source.h"
#include "shared/field/field.h"

namespace scree {

/// Takes a field from before a tick to after it: the bricks that the tick changed. Not of a jump.
void follow_bricks(const TickDelta& delta, Field& field);

/// The state after the tick at which the source stands, as one tick: the first next() after
/// ReplaySource::seek(), and nothing at all before tick 1.
Result<std::shared_ptr<const TickDelta>> state_at_start(ReplaySource& source);

/// The terrain after a tick of the recording; its start is a tick, too. The error names the ticks that there
/// are.
Result<std::unique_ptr<Field>> field_at(const std::string& path, Tick tick, const GroundGiver& ground);

}  // namespace scree
