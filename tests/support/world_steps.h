// A world stepped by hand, and what came of a tick.
#pragma once

#include <memory>
#include <vector>

#include "server/world/world.h"

namespace scree {

/// A few blows have become terrain again within this number of ticks.
inline constexpr int settle_ticks_max = 1800;

inline std::shared_ptr<const TickDelta> step(World& world, const std::vector<Command>& commands = {}) {
  return world.step(commands);
}

inline MassUnits mass_of(const std::vector<SpawnedPiece>& pieces) {
  MassUnits mass = 0;
  for (const SpawnedPiece& piece : pieces) mass += piece.volume->mass;
  return mass;
}

}  // namespace scree
