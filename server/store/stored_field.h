// The terrain of a kept world for reading, whatever its size: chunks are read from its file when they are
// asked for, and let go again.
#pragma once

#include <memory>

#include "server/store/world_file.h"

namespace scree {

/// `source`: the ground that the file names. Keeps about so many edited bricks in memory. Reads all chunks
/// once: the error names a damaged row. Later, ChunkUnreadable is thrown when a chunk cannot be read again,
/// or was saved anew meanwhile (WorldFile::hold_moment).
Result<std::unique_ptr<Field>> stored_field(std::unique_ptr<WorldFile> file, const TerrainSource& source,
                                            size_t bricks_max);

}  // namespace scree
