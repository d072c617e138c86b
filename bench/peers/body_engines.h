// Jolt and Rapier as npm has them, compiled for WebAssembly: they take up a world's bodies and step them.
#pragma once

#include <string>
#include <vector>

#include "server/world/world.h"
#include "shared/base/result.h"

namespace scree::peers {

struct SteppedBodies {
  std::string version;  ///< of the package
  std::vector<double> ticks_ms;
  size_t awake = 0;    ///< bodies after the last tick
  size_t through = 0;  ///< bodies that lie a metre below the lowest ground, or more
};

/// Writes pieces as one convex hull each, props as box, capsule or hull by their first part, where all of
/// them are, and how they move. The ground within 32 m of the origin follows, as heights every quarter of a
/// metre. Error: the file cannot be written.
Result<void> write_bodies(World& world, const std::string& path);

/// Steps the bodies of such a file `ticks` times by a 60th of a second, in one thread of a process of its
/// own. `engine`: "jolt" or "rapier". Error: Node or the engine's package is not there (`./scree bench`
/// installs it), or the engine failed.
Result<SteppedBodies> step_bodies_with(const std::string& engine, const std::string& path, Tick ticks);

}  // namespace scree::peers
