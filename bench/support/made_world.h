// A world's file that is written chunk by chunk, as of a moment in which nothing else happened: worlds of any
// size are made without a simulation, and without their terrain in memory.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/store/world_file.h"
#include "server/world/world_config.h"

namespace scree {

class MadeWorld {
 public:
  /// A new file, which appears under its name when it is finished; nothing is synced.
  static Result<MadeWorld> create(const std::string& path, const WorldConfig& config);
  /// A chunk's edited bricks, in order, each chunk once; `ground`: what the unedited ground weighs there.
  Result<void> add(ChunkCoord chunk, std::vector<BrickPatch> bricks, MassUnits ground);
  /// Writes what is left, and the moment. The last call.
  Result<void> finish();

  uint64_t bytes_written() const { return file_->bytes_written(); }

 private:
  MadeWorld(std::string path, const WorldConfig& config, std::unique_ptr<WorldFile> file);
  Result<void> write();

  std::string path_;
  WorldConfig config_;
  std::unique_ptr<WorldFile> file_;
  WorldMoment moment_;
  MassUnits gain_ = 0;  ///< of the terrain
  std::vector<WorldChunk> unwritten_;
};

}  // namespace scree
