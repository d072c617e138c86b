#include "server/publish/chunk_part.h"

#include <algorithm>

#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int bricks_per_chunk = chunk_bricks * chunk_bricks * chunk_bricks;

uint64_t bit_of(int index) {
  return uint64_t{1} << index;
}

}  // namespace

ChosenBricks choose_bricks(uint64_t lacking, int first, size_t bytes) {
  CHECK(0 <= first && first < bricks_per_chunk);
  size_t left = std::max<size_t>(1, bytes / limits::patch_brick_bytes);
  ChosenBricks chosen{0, first};
  for (int i = 0; i < bricks_per_chunk && left > 0; ++i) {
    const int index = (first + i) % bricks_per_chunk;
    if ((lacking & bit_of(index)) == 0) continue;
    chosen.bricks |= bit_of(index);
    chosen.next = (index + 1) % bricks_per_chunk;
    --left;
  }
  return chosen;
}

ChunkMessage part_of_chunk(ChunkCoord coord, const PublishedChunk& chunk, uint64_t bricks, bool more) {
  ChunkMessage part;
  part.chunk = coord;
  part.version = chunk.version;
  part.edited = chunk.edited;
  part.more = more;
  if (!more) part.hash = chunk.hash;
  for (const auto& [brick, state] : chunk.bricks)
    if ((bricks & bit_of(index_in_chunk(brick))) != 0)
      part.bricks.push_back({brick, *state.brick, state.materials});
  CHECK(part.is_part());
  return part;
}

}  // namespace scree
