// The nodes of a glTF file, each of which may have others as its children. Internal to import/assimp.
#pragma once

#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// Refuses nodes in a circle, nodes nested deeper than limits::scene_nesting_max, and nodes that come to more
/// than limits::scene_nodes_max where one is the child of several. The JSON is not nested too deep itself.
Result<void> check_gltf_nodes(std::string_view json);

}  // namespace scree
