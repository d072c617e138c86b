// Where a world, or a recording, finds its ground again: files name it by its hash (name_of), so that it may
// lie anywhere, under any name.
#pragma once

#include <string>
#include <vector>

#include "ground/ground_file.h"

namespace scree {

/// Where the ground of a file is looked for: in the file's own folder, and in that of all grounds,
/// $XDG_DATA_HOME/scree/grounds or ~/.local/share/scree/grounds.
std::vector<std::string> ground_folders(const std::string& path);

/// The first file of that name in the folders, whole. Looks at files that end in .ground, by their headers;
/// folders that are not there are skipped. The error says the hash, and where it was looked for.
Result<std::shared_ptr<const GroundFile>> find_ground(const Digest& name,
                                                      const std::vector<std::string>& folders);

}  // namespace scree
