// Scenes of many bodies that move, tick by tick, for the bench of their poses on the wire.
#pragma once

#include <memory>
#include <vector>

#include "server/world/tick_delta.h"
#include "shared/field/piece.h"

namespace scree {

struct PoseTick {
  std::shared_ptr<const TickDelta> delta;
  std::vector<Pose> exact;  ///< of delta->pieces, as the simulation has them; empty: not known
};

/// 900 boxes of 0.4 m on a plain, and a cube of 1.5 m that is driven to and fro through them, as in Fiedler,
/// "Networked Physics" (2014).
std::vector<PoseTick> pushed_boxes(uint32_t ticks);

/// A blast in a plain that makes about 1,000 pieces; they stay where they come to rest.
std::vector<PoseTick> blast(uint32_t ticks);

}  // namespace scree
