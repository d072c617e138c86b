// The terrain of a kept world for reading, whatever its size: chunk by chunk, or as a field whose chunks are
// read from the file when they are asked for, and let go again.
#pragma once

#include <memory>

#include "server/store/world_file.h"

namespace scree {

/// The terrain of a file for World::restore(). `ground` takes what the ground weighs in each chunk whose row
/// says so; it and the file must outlive the result's `each`. `read` gives a chunk again, later.
PagedTerrain terrain_of(WorldFile& file, ReadChunk read, GroundMasses& ground, size_t bricks_max);

/// Makes a file of a world as it stands, chunk by chunk (WorldFile::create).
Result<void> create_world(const std::string& path, const WorldHeader& header, World& world);

/// `source`: the ground that the file names. Keeps about so many edited bricks in memory. Reads all chunks
/// once: the error names a damaged row. Later, ChunkUnreadable is thrown when a chunk cannot be read again,
/// or was saved anew meanwhile (WorldFile::hold_moment).
Result<std::unique_ptr<Field>> stored_field(std::unique_ptr<WorldFile> file, const TerrainSource& source,
                                            size_t bricks_max);

}  // namespace scree
