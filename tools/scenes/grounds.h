// Scenes whose ground is a file.
#pragma once

#include "tools/scenes/scene.h"

namespace scree {

/// Six houses of walls, floors and roofs, each of closed meshes, on level rock.
Result<SceneSetup> city_scene(const std::string& folder);

/// The elevation model of data/maunga_whau.asc, which must lie where this was built.
Result<SceneSetup> maunga_whau_scene(const std::string& folder);

}  // namespace scree
