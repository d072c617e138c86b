// How deep files of scenes are nested. assimp, and the libraries under it, go down into them by recursion,
// which ends a process where the stack does. Internal to import/assimp.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Whether files of that ending are nested at all.
bool is_nested_form(const std::string& ending);

/// Refuses glTF, GLB, Collada and FBX that are nested deeper than limits::scene_nesting_max, and glTF whose
/// nodes are no tree or too many. `ending`: of the file's name.
Result<void> check_nesting(const std::string& file, const std::string& ending);

}  // namespace scree
