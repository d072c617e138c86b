// A street of buildings of all materials of the built-in palette, built of fills.
#pragma once

#include "tools/scenes/scene.h"

namespace scree {

/// A house of bricks, an office of steel and glass, a hut of timber, and what lies about; 52 by 12 by 28 m.
Result<SceneSetup> street_scene(const std::string& folder);

}  // namespace scree
