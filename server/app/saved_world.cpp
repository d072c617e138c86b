#include "server/app/saved_world.h"

#include <algorithm>
#include <filesystem>
#include <spdlog/spdlog.h>

#include "crypto/signing_key.h"
#include "server/app/temporary_world.h"
#include "server/app/terrain_pager.h"
#include "server/store/stored_field.h"
#include "server/work/memory.h"
#include "server/world/limits.h"
#include "server/world/recorded_values.h"
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
                                                     size_t threads, const GroundGiver& ground,
                                                     size_t bricks_max) {
  auto lock = TRY(WorldLock::take(path));
  std::unique_ptr<SavedWorld> kept(new SavedWorld(path, std::move(lock)));
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    auto world = TRY(World::create(config, threads));
    kept->world_ = std::move(world);
    kept->number_ = std::max<uint64_t>(1, random_number());
    return kept;
  }
  auto file = TRY(WorldFile::open(path));
  size_t chunks = 0;
  auto world = TRY(restored(*file, threads, ground, bricks_max, *kept, chunks));
  tell_differences(path, config, world->config());
  spdlog::info("{}: goes on at tick {} with {} edited chunks, {} of them in memory", path, world->tick(),
               chunks, world->field().chunks_in().size());
  kept->file_ = std::move(file);
  kept->world_ = std::move(world);
  return kept;
}

/// The world of the file; of its terrain as much as there is memory for.
Result<std::unique_ptr<World>> SavedWorld::restored(WorldFile& file, size_t threads,
                                                    const GroundGiver& ground, size_t bricks_max,
                                                    SavedWorld& kept, size_t& chunks) {
  const std::string& path = file.path();
  auto rows = TRY(file.read_moment());
  RecordedHeader& header = rows.world.moment.config;
  if (auto given = give_ground(header.ground, header.terrain, ground); !given)
    return fail(path + ": " + given.error().message);
  auto reader = TRY(chunk_reader(path));
  const auto config = config_of(header);
  const uint32_t max_mb = config ? config->memory_max_mb : limits::memory_max_min_mb;
  GroundMasses masses;
  const PagedTerrain terrain = terrain_of(file, std::move(reader), masses,
                                          bricks_max != 0 ? bricks_max : bricks_within(max_mb, {}) / 2);
  auto world = World::restore(rows.world, terrain, threads, masses);
  if (!world) return fail(path + ": damaged: " + world.error().message);
  chunks = (*world)->field().chunks_in().size() + (*world)->field().chunks_out();
  kept.number_ = rows.header.world;
  kept.first_session_ = first_free_session(rows.world.moment);
  return world;
}

Result<std::unique_ptr<SavedWorld>> SavedWorld::open_temporary(const WorldConfig& config, size_t threads) {
  auto path = TRY(temporary_world_path());
  auto kept = open(path, config, threads, {});
  if (!kept) {
    remove_world(path);
    return kept;
  }
  (*kept)->temporary_ = true;
  return kept;
}

SavedWorld::~SavedWorld() {
  keeper_.reset();
  file_.reset();
  if (temporary_) remove_world(path_);
}

Result<void> SavedWorld::start(World& world, KeeperConfig config) {
  if (file_ == nullptr) {
    const WorldSnapshot value = world.snapshot();
    WorldHeader header{.world = number_, .config = value.moment.config};
    header.config.program = "scree-server " SCREE_VERSION;
    auto file = TRY(WorldFile::create(path_, header, value, !temporary_));
    file_ = std::move(file);
  }
  keeper_ = std::make_unique<WorldKeeper>(std::move(file_), world.tick(), world.config().terrain,
                                          std::move(config));
  return {};
}

void SavedWorld::keep(const TickDelta& delta, World& world, bool pressed) {
  const KeeperStatus status = keeper_->status();
  if (keeper_->note(delta, pressed || !status.lacking.empty()))
    keeper_->save(world.moment(), chunk_now(world.field()));
  complain(status);
}

/// Each failure once.
void SavedWorld::complain(const KeeperStatus& status) {
  const std::string now = status.error.value_or("");
  if (now == complaint_) return;
  complaint_ = now;
  if (temporary_ && !now.empty())
    spdlog::warn(
        "terrain cannot leave memory{}: edits are refused once it is full (memory-max); give the server a "
        "folder with room (XDG_CACHE_HOME), or a world to keep (--world): {}",
        status.given_up ? " any more" : ", which is tried again", now);
  else if (now.empty())
    spdlog::info("the world is saved again, up to tick {}", status.saved_tick);
  else if (status.given_up)
    spdlog::error("the world is not saved any more; the file holds tick {}: {}", status.saved_tick, now);
  else
    spdlog::warn("the world is not saved since tick {}, and is tried again: {}", status.saved_tick, now);
}

void SavedWorld::abandon() {
  keeper_.reset();
}

Result<void> SavedWorld::finish(World& world) {
  if (temporary_) {
    abandon();
    return {};
  }
  const Result<void> finished = keeper_->finish(world.moment(), chunk_now(world.field()));
  complain(keeper_->status());
  return finished;
}

}  // namespace scree
