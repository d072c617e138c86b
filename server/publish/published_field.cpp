#include "server/publish/published_field.h"

#include "shared/base/check.h"

namespace scree {

PublishedField::PublishedField(const TerrainSource& source, const PublishedState& state)
    : Field(source), state_(state) {
  for (const auto& [coord, chunk] : state.chunks()) behind_.insert(coord);
}

bool PublishedField::follow(size_t chunks_max) {
  for (; chunks_max > 0 && !behind_.empty(); --chunks_max) {
    const ChunkCoord chunk = *behind_.begin();
    behind_.erase(behind_.begin());
    take_up(chunk);
  }
  return behind_.empty();
}

void PublishedField::take_up(ChunkCoord coord) {
  partial_.erase(coord);
  const auto found = state_.chunks().find(coord);
  if (found == state_.chunks().end()) {
    mark_chunk(coord, 0, 0, {});
    return;
  }
  const PublishedChunk& chunk = found->second;
  std::map<int, BrickMaterials> said;
  for (const auto& [brick, state] : chunk.bricks)
    if (!state.materials.is_ground()) said.emplace(index_in_chunk(brick), state.materials);
  if (!chunk.is_whole()) partial_.insert(coord);
  mark_chunk(coord, chunk.edited, chunk.hash, std::move(said));
}

std::vector<ChunkCoord> PublishedField::take_missing() {
  std::vector<ChunkCoord> missing(missing_.begin(), missing_.end());
  behind_.insert(missing.begin(), missing.end());
  missing_.clear();
  return missing;
}

const Brick* PublishedField::find_edited(BrickCoord coord) const {
  const ChunkCoord at = chunk_of(coord);
  const auto chunk = state_.chunks().find(at);
  if (chunk == state_.chunks().end() || ((chunk->second.edited >> index_in_chunk(coord)) & 1U) == 0)
    return nullptr;
  const auto brick = chunk->second.bricks.find(coord);
  if (brick != chunk->second.bricks.end() && !partial_.contains(at)) return brick->second.brick.get();
  missing_.insert(at);
  throw ChunkUnreadable("a chunk is out of the publisher's memory");
}

void PublishedField::store_edited(BrickCoord /*coord*/, const Brick& /*brick*/) {
  CHECK(false, "the published terrain is only read");
}

void PublishedField::erase_edited(BrickCoord /*coord*/) {
  CHECK(false, "the published terrain is only read");
}

}  // namespace scree
