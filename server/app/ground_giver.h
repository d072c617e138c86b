// How the programs find the ground that a world's file or a recording names: the one that the command line
// gives
// (--ground), or else a file beside it, or one of the folder of all grounds (ground/ground_search.h).
#pragma once

#include <string>

#include "server/world/world_config.h"

namespace scree {

/// `path`: the file that names its ground. `given`: has the ground of the command line, if there is one; then
/// another one is refused.
GroundGiver ground_giver(const std::string& path, const WorldConfig& given);
/// As above; `ground_path` is a ground file to open first, or empty.
Result<GroundGiver> ground_giver(const std::string& path, const std::string& ground_path);

/// Opens a ground file as the terrain of a configuration.
Result<void> set_ground(const std::string& ground_path, WorldConfig& config);

/// For programs: the ground's hash, or the name of the kind that generates it.
std::string terrain_text(const Digest& ground, const TerrainSource& terrain);

}  // namespace scree
