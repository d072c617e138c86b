#include "server/app/saved_world.h"

#include <algorithm>
#include <filesystem>
#include <spdlog/spdlog.h>

#include "crypto/signing_key.h"
#include "server/world/settings.h"
#include "server/world/world_snapshot.h"

namespace scree {

namespace {

/// What was asked for, and the file says otherwise: the file has the last word.
void tell_differences(const std::string& path, const WorldConfig& asked, const WorldConfig& kept) {
  if (!is_same_terrain(asked, kept) || asked.tick_rate_hz != kept.tick_rate_hz)
    spdlog::info("{}: terrain and tick rate are the file's", path);
  const SettingValues wanted = print(asked), stand = print(kept);
  for (size_t i = 0; i < stand.size(); ++i)
    if (stand[i] != wanted[i])
      spdlog::info("{}: {} is {}, as it was saved, not {}", path, stand[i].name, stand[i].value,
                   wanted[i].value);
}

}  // namespace

Result<std::unique_ptr<SavedWorld>> SavedWorld::open(const std::string& path, const WorldConfig& config,
                                                     size_t threads, const GroundGiver& ground) {
  auto lock = WorldLock::take(path);
  if (!lock) return tl::unexpected(lock.error());
  std::unique_ptr<SavedWorld> kept(new SavedWorld(path, std::move(*lock)));
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    auto world = World::create(config, threads);
    if (!world) return tl::unexpected(world.error());
    kept->world_ = std::move(*world);
    kept->number_ = std::max<uint64_t>(1, random_number());
    return kept;
  }
  auto file = WorldFile::open(path);
  if (!file) return tl::unexpected(file.error());
  auto rows = (*file)->read();
  if (!rows) return tl::unexpected(rows.error());
  RecordedHeader& header = rows->world.moment.config;
  if (auto given = give_ground(header.ground, header.terrain, ground); !given)
    return fail(path + ": " + given.error().message);
  auto world = World::restore(rows->world, threads, rows->ground);
  if (!world) return fail(path + ": damaged: " + world.error().message);
  tell_differences(path, config, (*world)->config());
  spdlog::info("{}: goes on at tick {} with {} pieces and {} edited chunks", path, (*world)->tick(),
               rows->world.moment.pieces.size(), rows->chunks.size());
  kept->file_ = std::move(*file);
  kept->world_ = std::move(*world);
  kept->ground_ = std::move(rows->ground);
  kept->number_ = rows->header.world;
  kept->first_session_ = first_free_session(rows->world.moment);
  return kept;
}

Result<void> SavedWorld::start(World& world, KeeperConfig config) {
  if (file_ == nullptr) {
    const WorldSnapshot value = world.snapshot();
    WorldHeader header{.world = number_, .config = value.moment.config};
    header.config.program = "scree-server " SCREE_VERSION;
    auto file = WorldFile::create(path_, header, value);
    if (!file) return tl::unexpected(file.error());
    file_ = std::move(*file);
  }
  keeper_ = std::make_unique<WorldKeeper>(std::move(file_), world.keyframe(), world.config().terrain, ground_,
                                          std::move(config));
  return {};
}

void SavedWorld::keep(const TickDelta& delta, const World& world) {
  if (keeper_->note(delta)) keeper_->save(world.moment());
  complain();
}

/// Each failure once.
void SavedWorld::complain() {
  const KeeperStatus status = keeper_->status();
  const std::string now = status.error.value_or("");
  if (now == complaint_) return;
  complaint_ = now;
  if (now.empty())
    spdlog::info("the world is saved again, up to tick {}", status.saved_tick);
  else if (status.given_up)
    spdlog::error("the world is not saved any more; the file holds tick {}: {}", status.saved_tick, now);
  else
    spdlog::warn("the world is not saved since tick {}, and is tried again: {}", status.saved_tick, now);
}

Result<void> SavedWorld::finish(const World& world) {
  const Result<void> finished = keeper_->finish(world.moment());
  complain();
  return finished;
}

}  // namespace scree
