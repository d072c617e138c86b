// A store of props: what a game adds to a world, on a dock and on a wall that breaks beneath it.
#pragma once

#include "tools/scenes/scene.h"

namespace scree {

/// Crates stacked on a dock, barrels, balls and a crate on a wall of bricks, and a laid table before them.
Result<SceneSetup> store_scene(const std::string& folder);

}  // namespace scree
