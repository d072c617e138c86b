// A chunk as text, for people and for `diff`: two dumps of equal chunks are equal, line by line.
#pragma once

#include <span>
#include <string>

#include "shared/base/result.h"
#include "shared/field/brick_patch.h"

namespace scree {

/// The edited bricks of a chunk in order: a line with coordinate, paint and hash, then the codes. A brick of
/// only air, or only rock, says so instead. Codes come in 8 layers from the highest down, a line for each x;
/// within a line z grows. `#` is rock beyond the narrow band, `.` is air beyond it.
std::string chunk_text(ChunkCoord chunk, std::span<const BrickPatch> bricks);

/// The same of a chunk in the file of a world, as it was saved last.
Result<std::string> saved_chunk_text(const std::string& path, ChunkCoord chunk);

}  // namespace scree
