// The part of a tick that all clients have in common (client_view.h).
#include <algorithm>
#include <iterator>

#include "server/publish/client_view.h"
#include "shared/base/check.h"

namespace scree {

ChunkSet unedited_before(const TickDelta& delta, const PublishedState& before) {
  CHECK(before.tick() == 0 || before.tick() + 1 == delta.tick, "the state must be the one before the tick");
  ChunkSet unedited;
  const auto look = [&](ChunkCoord chunk) {
    if (!before.chunks().contains(chunk)) unedited.insert(chunk);
  };
  for (const BrickState& brick : delta.bricks) look(chunk_of(brick.coord));
  for (const AppliedOperation& operation : delta.operations) {
    std::ranges::for_each(operation.reads, look);
    std::ranges::for_each(operation.writes, look);
  }
  return unedited;
}

TickChanges::TickChanges(const TickDelta& d, const ChunkSet& unedited_chunks, const PublishedState& after,
                         const Motions& m, const TerrainSource& ground)
    : delta(d), state(after), motions(m), voxel_size_m(ground.voxel_size_m) {
  CHECK_EQ(after.tick(), d.tick, "the state must be the one after the tick");
  for (const BrickState& brick : d.bricks) bricks[chunk_of(brick.coord)].push_back(&brick);
  for (const auto& [chunk, list] : bricks) {
    if (unedited_chunks.contains(chunk)) fresh.insert(chunk);
    orphan.insert(chunk);
  }
  for (const BrickCoord brick : d.reverted) reverted.insert(chunk_of(brick));
  ended.reserve(d.operations.size());
  needs.reserve(d.operations.size());
  opens.reserve(d.operations.size());
  for (const AppliedOperation& operation : d.operations) {
    ended.push_back(pieces_ended_by(operation.operation));
    for (const ChunkCoord chunk : operation.writes) orphan.erase(chunk);
    std::vector<ChunkCoord>& needed = needs.emplace_back();
    std::ranges::set_union(operation.reads, operation.writes, std::back_inserter(needed));
    // The others are the same on every client: nothing but operations of this tick has ever changed them.
    const auto unedited = [&](ChunkCoord chunk) { return unedited_chunks.contains(chunk); };
    std::erase_if(needed, unedited);
    std::ranges::copy_if(operation.writes, std::back_inserter(opens.emplace_back()), unedited);
    std::set<TileKey>& decide = tiles.emplace_back();
    if (ground.heights == nullptr) continue;
    for (const auto& chunks : {operation.reads, operation.writes})
      for (const ChunkCoord chunk : chunks)
        for (const TileKey key : tiles_of(ground, chunk)) decide.insert(key);
  }
}

}  // namespace scree
