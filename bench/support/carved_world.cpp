#include "bench/support/carved_world.h"

#include <limits>

#include "bench/support/made_world.h"
#include "bench/support/scenes.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr int reach_of_a_carve_voxels = 32;  ///< more than one reads, and writes
constexpr uint32_t rows_between_writes = 4;  ///< few chunks are looked at twice

/// Chunks behind that z, voxels, are written and forgotten.
Result<void> write_behind(MapField& field, MadeWorld& world, int z) {
  for (const ChunkCoord chunk : field.edited_chunks()) {
    if ((chunk.z + 1) * chunk_size > z) continue;
    std::vector<BrickPatch> bricks;
    MassUnits ground = 0;
    for (const BrickCoord coord : field.edited_bricks(chunk)) {
      bricks.push_back({coord, field.brick(coord), field.materials(coord)});
      ground += brick_mass(field.generated_brick(coord));
    }
    std::ranges::sort(bricks, {}, &BrickPatch::coord);
    TRY(world.add(chunk, std::move(bricks), ground));
    field.forget_chunk(chunk);
  }
  return {};
}

}  // namespace

Result<void> write_carved_world(const std::string& path, const CarvedGround& ground) {
  auto world = TRY(MadeWorld::create(path, ground.config));
  const TerrainSource& terrain = ground.config.terrain;
  MapField field(terrain);
  BlowGrid blows(terrain, ground.carves_a_side, ground.spacing_m, ground.radius_m, 1);
  PieceTable pieces;
  for (uint32_t made = 1; const auto blow = blows.next(); ++made) {
    apply(CarveOperation{blow->shape, blow->pattern, 1, blow->random_seed, blow->impact_m, 1}, field, pieces);
    pieces.clear();
    if (made % (rows_between_writes * ground.carves_a_side) != 0) continue;
    const int behind = floor_to_int(blow->impact_m.z / terrain.voxel_size_m) - reach_of_a_carve_voxels;
    TRY(write_behind(field, world, behind));
  }
  TRY(write_behind(field, world, std::numeric_limits<int>::max()));
  return world.finish();
}

}  // namespace scree
