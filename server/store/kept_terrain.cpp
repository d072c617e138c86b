#include "server/store/kept_terrain.h"

namespace scree {

KeptTerrain::KeptTerrain(const TerrainSource& ground, const TickDelta& keyframe, const GroundMasses& known)
    : ground_(ground) {
  for (const BrickState& state : keyframe.bricks) {
    Chunk& chunk = chunks_[chunk_of(state.coord)];
    chunk.bricks[state.coord] = state;
    chunk.hash += state.hash;
  }
  for (const auto& [coord, mass] : known)
    if (const auto chunk = chunks_.find(coord); chunk != chunks_.end()) chunk->second.ground_mass = mass;
}

MassUnits KeptTerrain::ground_of(Chunk& chunk, BrickCoord brick) const {
  if (chunk.measured == nullptr)
    chunk.measured = std::make_unique<MassByBrick>(ground_masses(ground_, chunk_of(brick)));
  return (*chunk.measured)[static_cast<size_t>(index_in_chunk(brick))];
}

void KeptTerrain::change(const ChangedBricks& bricks) {
  for (const auto& [coord, state] : bricks) {
    Chunk& chunk = chunks_[chunk_of(coord)];
    if (!chunk.ground_mass) {
      chunk.ground_mass = 0;
      for (const auto& [known, ignored] : chunk.bricks) *chunk.ground_mass += ground_of(chunk, known);
    }
    if (!chunk.bricks.contains(coord)) *chunk.ground_mass += ground_of(chunk, coord);
    BrickState& slot = chunk.bricks[coord];
    chunk.hash += state.hash - slot.hash;
    slot = state;
    unsaved_.insert(chunk_of(coord));
  }
}

std::vector<WorldChunk> KeptTerrain::unsaved(Tick tick) const {
  std::vector<WorldChunk> list;
  for (const ChunkCoord coord : unsaved_) {
    const Chunk& chunk = chunks_.at(coord);
    WorldChunk& kept = list.emplace_back(WorldChunk{coord, tick, chunk.hash, {}, chunk.ground_mass});
    for (const auto& [brick, state] : chunk.bricks) kept.bricks.push_back({brick, *state.brick, state.paint});
  }
  return list;
}

}  // namespace scree
