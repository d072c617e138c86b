#include "server/replay/recorded_terrain.h"

namespace scree {

MassUnits RecordedTerrain::ground_under(const TerrainSource& ground, ChunkCoord chunk,
                                        std::span<const BrickPatch> bricks) {
  auto found = ground_.find(chunk);
  if (found == ground_.end()) found = ground_.emplace(chunk, ground_masses(ground, chunk)).first;
  MassUnits sum = 0;
  for (const BrickPatch& brick : bricks)
    sum += found->second[static_cast<size_t>(index_in_chunk(brick.coord))];
  return sum;
}

Result<std::vector<BrickPatch>> RecordedTerrain::read(ChunkCoord chunk) const {
  const auto hash = hashes_.find(chunk);
  if (hash == hashes_.end()) return fail(recording_->path() + " does not have a chunk");
  return recording_->chunk(chunk, hash->second);
}

Result<std::unique_ptr<World>> RecordedTerrain::restore(const WorldSnapshot& state) {
  const TerrainSource& terrain = state.moment.config.terrain;
  GroundMasses masses;
  hashes_.clear();
  PagedTerrain paged;
  paged.bricks_max = bricks_max_;
  paged.read = [this](ChunkCoord chunk) { return read(chunk); };
  paged.each = [&](const PagedTerrain::Visit& visit) {
    return recording_->each_chunk(state.moment.tick,
                                  [&](ChunkCoord chunk, std::span<const BrickPatch> bricks) -> Result<void> {
                                    uint64_t hash = 0;
                                    for (const BrickPatch& brick : bricks)
                                      hash += brick_hash(brick.coord, brick.brick, brick.materials);
                                    TRY(visit(chunk, bricks));  // it lies in the world
                                    hashes_[chunk] = hash;
                                    masses[chunk] = ground_under(terrain, chunk, bricks);
                                    return {};
                                  });
  };
  return World::restore(state, paged, 1, masses);
}

void RecordedTerrain::adopt(World& world) {
  world.paging().page_by([this](ChunkCoord chunk) { return read(chunk); });
}

void RecordedTerrain::make_room(World& world) {
  FieldPaging paging = world.paging();
  const Field& field = world.field();
  if (!field.pages()) return;
  paging.begin_turn();
  if (world.tick() % limits::ticks_per_make_room != 0 || field.bricks_in() <= bricks_max_) return;
  for (const ChunkCoord chunk : field.idle_chunks(1)) {
    if (field.bricks_in() <= bricks_max_ / 8 * 7) return;
    const uint64_t hash = field.chunk_hash(chunk);
    const auto has = recording_->has_chunk(chunk, hash, world.tick());
    if (!has.value_or(false)) continue;
    hashes_[chunk] = hash;
    paging.page_out(chunk);
  }
}

}  // namespace scree
