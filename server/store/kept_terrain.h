// A keeper's copy of a world's edited terrain: which chunks a save has to write, and what their rows hold.
// One thread at a time. Internal to server/store.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <vector>

#include "proto/world_codec.h"
#include "server/store/ground_mass.h"
#include "server/world/tick_delta.h"

namespace scree {

using ChangedBricks = std::unordered_map<BrickCoord, BrickState, CoordHash>;

class KeptTerrain {
 public:
  /// `keyframe`: every edited brick (World::keyframe); `known`: what the ground weighs under them, as far as
  /// the file says. The rest is measured when its chunk changes.
  KeptTerrain(const TerrainSource& ground, const TickDelta& keyframe, const GroundMasses& known);

  void change(const ChangedBricks& bricks);
  /// The rows of all chunks that changed since saved(), as of that tick.
  std::vector<WorldChunk> unsaved(Tick tick) const;
  void saved() { unsaved_.clear(); }

 private:
  struct Chunk {
    std::map<BrickCoord, BrickState> bricks;
    uint64_t hash = 0;
    std::optional<MassUnits> ground_mass;   ///< under the bricks
    std::unique_ptr<MassByBrick> measured;  ///< null until it is needed
  };
  /// Mass of the ground in a brick. Generates its chunk, once.
  MassUnits ground_of(Chunk& chunk, BrickCoord brick) const;

  TerrainSource ground_;
  std::unordered_map<ChunkCoord, Chunk, CoordHash> chunks_;
  std::set<ChunkCoord> unsaved_;
};

}  // namespace scree
