// Which chunks of a world's terrain a save has to write, and what their rows hold: all of a chunk's edited
// bricks. Those that did not change since the last save are read from its row. One thread at a time. Internal
// to server/store.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/formats/world_codec.h"
#include "server/store/ground_mass.h"
#include "server/world/tick_delta.h"

namespace scree {

using ChangedBricks = std::unordered_map<BrickCoord, BrickState, CoordHash>;

class UnsavedTerrain {
 public:
  /// A chunk as it was saved; nothing when it never was.
  using ReadSaved = std::function<Result<std::optional<WorldChunk>>(ChunkCoord)>;

  UnsavedTerrain(const TerrainSource& ground, ReadSaved read) : ground_(ground), read_(std::move(read)) {}

  /// Changes of a chunk whose row cannot be read are left out: lacking() names it until replace_chunk().
  void change(const ChangedBricks& bricks);
  /// Takes all edited bricks of a chunk as they are; its row need not be read.
  void replace_chunk(ChunkCoord chunk, const std::vector<BrickState>& bricks);
  /// Chunks whose rows cannot be read, and why not.
  const std::map<ChunkCoord, std::string>& lacking() const { return lacking_; }
  /// The rows of all chunks that changed since saved(), as of that tick.
  std::vector<WorldChunk> unsaved(Tick tick) const;
  /// Forgets chunks, when there are more than limits::chunks_between_saves_max.
  void saved();
  size_t chunks() const { return chunks_.size(); }

 private:
  struct Chunk {
    std::map<BrickCoord, BrickState> bricks;
    uint64_t hash = 0;
    MassUnits ground_mass = 0;              ///< under the bricks
    std::unique_ptr<MassByBrick> measured;  ///< null until it is needed
  };
  /// The chunk, as it was saved unless it is here already.
  Result<Chunk*> chunk_at(ChunkCoord coord);
  /// Mass of the ground in a brick. Generates its chunk, once.
  MassUnits ground_of(Chunk& chunk, BrickCoord brick) const;

  TerrainSource ground_;
  ReadSaved read_;
  std::unordered_map<ChunkCoord, Chunk, CoordHash> chunks_;
  std::set<ChunkCoord> unsaved_;
  std::map<ChunkCoord, std::string> lacking_;
};

}  // namespace scree
