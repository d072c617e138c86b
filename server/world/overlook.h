// A place from which a ground shows well, for worlds where nobody chose one: some metres above the ground,
// under the sky, with relief in the middle distance and the horizon in the picture.
#pragma once

#include "shared/base/spawn.h"
#include "shared/field/terrain.h"

namespace scree {

/// A pure function of the ground, near its middle. It reads about a thousand heights, which takes
/// milliseconds. For a ground by heights its tiles must be there.
Spawn overlook_of(const TerrainSource& source);

}  // namespace scree
