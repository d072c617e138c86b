// Files of worlds that nobody keeps: they have room for terrain that is out of memory, and go with the
// server.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// A name for this process' next one, in $XDG_CACHE_HOME/scree or ~/.cache/scree, else in the folder for
/// temporary files. Removes those that processes left behind that are gone. An error if there is no folder.
Result<std::string> temporary_world_path();

/// Removes a world's file, and those beside it.
void remove_world(const std::string& path);

}  // namespace scree
