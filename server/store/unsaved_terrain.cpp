#include "server/store/unsaved_terrain.h"

#include "server/store/limits.h"
#include "server/world/shared_brick.h"

namespace scree {

MassUnits UnsavedTerrain::ground_of(Chunk& chunk, BrickCoord brick) const {
  if (chunk.measured == nullptr)
    chunk.measured = std::make_unique<MassByBrick>(ground_masses(ground_, chunk_of(brick)));
  return (*chunk.measured)[static_cast<size_t>(index_in_chunk(brick))];
}

Result<UnsavedTerrain::Chunk*> UnsavedTerrain::chunk_at(ChunkCoord coord) {
  if (const auto found = chunks_.find(coord); found != chunks_.end()) return &found->second;
  const auto saved = TRY(read_(coord));
  Chunk& chunk = chunks_[coord];
  if (!saved.has_value()) return &chunk;
  for (const BrickPatch& patch : saved->bricks)
    chunk.bricks[patch.coord] = {patch.coord, shared_copy(patch.brick),
                                 brick_hash(patch.coord, patch.brick, patch.materials), patch.materials};
  chunk.hash = saved->hash;
  if (saved->ground_mass) {
    chunk.ground_mass = *saved->ground_mass;
    return &chunk;
  }
  for (const auto& [brick, ignored] : chunk.bricks) chunk.ground_mass += ground_of(chunk, brick);
  return &chunk;
}

void UnsavedTerrain::change(const ChangedBricks& bricks) {
  for (const auto& [coord, state] : bricks) {
    const ChunkCoord at = chunk_of(coord);
    if (lacking_.contains(at)) continue;
    const Result<Chunk*> found = chunk_at(at);
    if (!found) {
      lacking_[at] = found.error().message;
      continue;
    }
    Chunk& chunk = **found;
    if (!chunk.bricks.contains(coord)) chunk.ground_mass += ground_of(chunk, coord);
    BrickState& slot = chunk.bricks[coord];
    chunk.hash += state.hash - slot.hash;
    slot = state;
    unsaved_.insert(at);
  }
}

void UnsavedTerrain::replace_chunk(ChunkCoord coord, const std::vector<BrickState>& bricks) {
  Chunk chunk;
  for (const BrickState& state : bricks) {
    chunk.hash += state.hash;
    chunk.ground_mass += ground_of(chunk, state.coord);
    chunk.bricks[state.coord] = state;
  }
  chunks_.insert_or_assign(coord, std::move(chunk));
  unsaved_.insert(coord);
  lacking_.erase(coord);
}

std::vector<WorldChunk> UnsavedTerrain::unsaved(Tick tick) const {
  std::vector<WorldChunk> list;
  for (const ChunkCoord coord : unsaved_) {
    const Chunk& chunk = chunks_.at(coord);
    WorldChunk& row = list.emplace_back(WorldChunk{coord, tick, chunk.hash, {}, chunk.ground_mass});
    for (const auto& [brick, state] : chunk.bricks)
      row.bricks.push_back({brick, *state.brick, state.materials});
  }
  return list;
}

void UnsavedTerrain::saved() {
  if (chunks_.size() > limits::chunks_between_saves_max)
    std::erase_if(chunks_, [this](const auto& entry) { return !unsaved_.contains(entry.first); });
  if (chunks_.size() > limits::chunks_between_saves_max) chunks_.clear();
  unsaved_.clear();
}

}  // namespace scree
