// The terrain of a world that is simulated from a recording, within memory: its chunks come from the
// recording's rows, and those that changed go out once a row has them as they are. One thread at a time.
#pragma once

#include <unordered_map>

#include "server/store/ground_mass.h"
#include "server/store/limits.h"
#include "server/store/recording_reader.h"
#include "server/world/world.h"

namespace scree {

class RecordedTerrain {
 public:
  /// Keeps about so many edited bricks in memory. `recording` must outlive it, and this object the worlds
  /// that it is for.
  explicit RecordedTerrain(RecordingReader& recording, size_t bricks_max = limits::simulated_bricks_max)
      : recording_(&recording), bricks_max_(bricks_max) {}

  /// The world of the state after a tick, whose value is given; its ground is there.
  Result<std::unique_ptr<World>> restore(const WorldSnapshot& state);
  /// Adopts a world that begins untouched.
  void adopt(World& world);
  /// After each tick of such a world: lets chunks go when there are too many.
  void make_room(World& world);

 private:
  Result<std::vector<BrickPatch>> read(ChunkCoord chunk) const;
  /// What the ground weighs under these bricks of a chunk. Generates it, once.
  MassUnits ground_under(const TerrainSource& ground, ChunkCoord chunk, std::span<const BrickPatch> bricks);

  RecordingReader* recording_;
  size_t bricks_max_;
  std::unordered_map<ChunkCoord, uint64_t, CoordHash> hashes_;  ///< of chunks that may be out
  std::unordered_map<ChunkCoord, MassByBrick, CoordHash> ground_;
};

/// What `f` returns, or the error when a chunk that is out is needed and cannot be read.
template <typename F>
auto with_terrain(F&& f) -> decltype(f()) {
  try {
    return f();
  } catch (const ChunkUnreadable& unreadable) {
    return fail(unreadable.what());
  }
}

}  // namespace scree
