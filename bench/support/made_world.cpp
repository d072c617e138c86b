#include "bench/support/made_world.h"

#include <filesystem>
#include <utility>

#include "server/app/temporary_world.h"
#include "server/bodies/bodies.h"
#include "server/world/recorded_values.h"
#include "server/world/state_hash.h"
#include "server/world/world.h"

namespace scree {

namespace {

constexpr size_t chunks_per_save = 512;  ///< one transaction
constexpr const char* unfinished = "-unfinished";

}  // namespace

MadeWorld::MadeWorld(std::string path, const WorldConfig& config, std::unique_ptr<WorldFile> file)
    : path_(std::move(path)), config_(config), file_(std::move(file)), moment_(World(config).moment()) {
  moment_.tick = 1;
}

Result<MadeWorld> MadeWorld::create(const std::string& path, const WorldConfig& config) {
  const WorldMoment nothing = World(config).moment();
  remove_world(path + unfinished);
  auto file =
      WorldFile::create(path + unfinished, {.world = 1, .config = nothing.config}, {nothing, {}}, false);
  TRY(file);
  return MadeWorld(path, config, std::move(*file));
}

Result<void> MadeWorld::add(ChunkCoord chunk, std::vector<BrickPatch> bricks, MassUnits ground) {
  WorldChunk& made = unwritten_.emplace_back(WorldChunk{chunk, 1, 0, std::move(bricks), ground});
  for (const BrickPatch& patch : made.bricks) {
    made.hash += brick_hash(patch.coord, patch.brick, patch.materials);
    gain_ += brick_mass(patch.brick);
  }
  gain_ -= ground;
  moment_.field_hash += made.hash;
  return unwritten_.size() < chunks_per_save ? Result<void>() : write();
}

Result<void> MadeWorld::write() {
  auto saved = file_->save(moment_, unwritten_);
  unwritten_.clear();
  return saved;
}

Result<void> MadeWorld::finish() {
  const Ledger ledger{.terrain = gain_, .dust = -gain_, .moved = -gain_};
  moment_.ledger = ledger;
  MapField none(config_.terrain);
  moment_.state_hash = state_hash(
      {moment_.tick, moment_.field_hash, Bodies(none, {}).state_hash(), moment_.next_piece, ledger});
  TRY(write());
  file_.reset();  // its log goes into it
  std::error_code error;
  std::filesystem::rename(path_ + unfinished, path_, error);
  return error ? fail(path_ + ": " + error.message()) : Result<void>();
}

}  // namespace scree
