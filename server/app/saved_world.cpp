#include "server/app/saved_world.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

#include "content/builtin_palette.h"
#include "crypto/signing_key.h"
#include "server/app/temporary_world.h"
#include "server/app/terrain_pager.h"
#include "server/app/world_materials.h"
#include "server/log/log.h"
#include "server/store/limits.h"
#include "server/store/stored_field.h"
#include "server/store/world_upgrade.h"
#include "server/work/memory.h"
#include "server/world/limits.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/world_snapshot.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/material/rubble.h"

namespace scree {

namespace {

/// What was asked for, and the file says otherwise: the file has the last word, but on limits of the machine.
void tell_differences(const std::string& path, const WorldConfig& asked, const WorldConfig& saved_world,
                      const SettingValues& told) {
  if (!is_same_terrain(asked, saved_world) || asked.tick_rate_hz != saved_world.tick_rate_hz)
    log_of(LogPart::store).info("{}: terrain and tick rate come from the file", path);
  const SettingValues wanted = print(asked);
  for (const SettingValue& stands : differing(print(saved_world), asked)) {
    const auto other = std::ranges::find(wanted, stands.name, &SettingValue::name);
    if (other == wanted.end())  // a number of a material
      log_of(LogPart::store)
          .info(
              "{}: {} is {}, as it was set before; scree admin materials set {}={} takes that of the "
              "palette",
              path, stands.name, stands.value, stands.name.substr(material_prefix.size()), own_number);
    else if (std::ranges::find(told, stands.name, &SettingValue::name) != told.end())
      log_of(LogPart::store)
          .info("{}: {} is {}, as this server was told, not {}, as it was saved", path, stands.name,
                other->value, stands.value);
    else
      log_of(LogPart::store)
          .info("{}: {} is {}, as it was saved, not {}", path, stands.name, stands.value, other->value);
  }
}

/// The way out for an operator whose file is no whole world. Empty: the error says enough.
std::string way_out(const std::string& path, const Error& error) {
  const auto is_said = [&](std::string_view words) { return error.message.find(words) != std::string::npos; };
  if (may_pass(error)) return {};
  if (is_said("it has only "))
    return ". Put a backup in its place; or move it away, and the server makes a new world";
  if (!is_said("damaged") && !is_said("malformed")) return {};
  return fmt::format(
      ". Start with a backup, or make a new world of all that is whole: scree world repair {} NEW.world",
      path);
}

/// Another program may hold the file for a moment, as one that looks at databases does.
Result<std::unique_ptr<World>> read_in_time(const std::function<Result<std::unique_ptr<World>>()>& read) {
  const double until_s = steady_now_s() + limits::last_tries_s;
  for (;;) {
    auto world = read();
    if (world || !may_pass(world.error()) || steady_now_s() > until_s) return world;
    log_of(LogPart::store).warn("the world cannot be read, and is tried again: {}", world.error().message);
    std::this_thread::sleep_for(std::chrono::duration<double>(limits::retry_held_max_s));
  }
}

}  // namespace

Result<std::unique_ptr<SavedWorld>> SavedWorld::open(const std::string& path, const WorldConfig& config,
                                                     size_t threads, const GroundGiver& ground,
                                                     size_t bricks_max, const SettingValues& told,
                                                     std::shared_ptr<const Palette> materials) {
  const Wanted wanted{bricks_max, told, std::move(materials)};
  auto lock = TRY(WorldLock::acquire(path));
  std::unique_ptr<SavedWorld> saved_world(new SavedWorld(path, std::move(lock)));
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    auto world = TRY(World::create(config, threads));
    saved_world->world_ = std::move(world);
    saved_world->is_new_ = true;
    saved_world->number_ = std::max<uint64_t>(1, random_number());
    return saved_world;
  }
  std::unique_ptr<WorldFile> file;
  size_t chunks = 0;
  int64_t format = 0;
  const auto read = [&]() -> Result<std::unique_ptr<World>> {
    file = TRY(WorldFile::open(path));
    format = TRY(file->format());
    return restored(*file, threads, ground, wanted, *saved_world, chunks);
  };
  auto world = read_in_time(read);
  if (!world) return fail(world.error().message + way_out(path, world.error()));
  const World& restored_world = **world;
  tell_differences(path, config, restored_world.config(), told);
  log_of(LogPart::store)
      .info("{}: goes on at tick {} with {} edited chunks, {} of them in memory", path, restored_world.tick(),
            chunks, restored_world.field().chunks_in().size());
  if (format < world_format)
    log_of(LogPart::store)
        .info("{}: it is of format {}: before its first save, a copy is kept as {}", path, format,
              name_of_older(path));
  saved_world->file_ = std::move(file);
  saved_world->world_ = std::move(*world);
  return saved_world;
}

/// The world of the file; of its terrain as much as there is memory for.
Result<std::unique_ptr<World>> SavedWorld::restored(WorldFile& file, size_t threads,
                                                    const GroundGiver& ground, const Wanted& wanted,
                                                    SavedWorld& saved_world, size_t& chunks) {
  const std::string& path = file.path();
  auto rows = TRY(file.read_moment());
  if (rows.stones_left_out > 0)
    log_of(LogPart::store)
        .warn("{}: stones that are drawn where pieces merged are left out: {} rows, the first: {}", path,
              rows.stones_left_out, rows.stone_left_out);
  RecordedHeader& header = rows.world.moment.config;
  if (auto given = give_ground(header.ground, header.terrain, ground); !given)
    return fail(path + ": " + given.error().message);
  if (auto given = give_materials(header, wanted.materials); !given)
    return fail(path + ": " + given.error().message);
  header.palette = with_rubble(header.palette ? header.palette : shared_builtin_palette());
  header.rules = rules::newest;  // the world goes on; what it was is in its recordings
  auto reader = TRY(chunk_reader(path));
  auto config = config_of(header);
  if (config) TRY(set_all(*config, wanted.told));
  const uint32_t max_mb = config ? config->memory_max_mb : limits::memory_max_min_mb;
  GroundMasses masses;
  const size_t bricks_max = wanted.bricks_max != 0 ? wanted.bricks_max : bricks_within(max_mb, {}) / 2;
  const PagedTerrain terrain = terrain_of(file, std::move(reader), masses, bricks_max);
  auto world = World::restore(rows.world, terrain, threads, masses);
  if (!world) return fail(path + ": damaged: " + world.error().message);
  chunks = (*world)->field().chunks_in().size() + (*world)->field().chunks_out();
  saved_world.number_ = rows.header.world;
  saved_world.first_session_ = first_free_session(rows.world.moment);
  return world;
}

Result<std::unique_ptr<SavedWorld>> SavedWorld::open_temporary(const WorldConfig& config, size_t threads) {
  auto path = TRY(temporary_world_path());
  auto saved_world = open(path, config, threads, {});
  if (!saved_world) {
    remove_world(path);
    return saved_world;
  }
  (*saved_world)->temporary_ = true;
  return saved_world;
}

SavedWorld::~SavedWorld() {
  saver_.reset();
  file_.reset();
  if (temporary_) remove_world(path_);
}

Result<void> SavedWorld::start(World& world, SaverConfig config) {
  CHECK(saver_ == nullptr, "a saved world starts once");
  if (is_new_) {
    const WorldSnapshot value = world.snapshot();
    WorldHeader header{.world = number_, .config = value.moment.config};
    header.config.program = "scree-server " SCREE_VERSION;
    auto file = TRY(WorldFile::create(path_, header, value, !temporary_));
    file_ = std::move(file);
  }
  saver_ =
      std::make_unique<WorldSaver>(std::move(file_), world.tick(), world.config().terrain, std::move(config));
  return {};
}

void SavedWorld::note(const TickDelta& delta, World& world, bool pressed) {
  const SaverStatus status = saver_->status();
  if (saver_->note(delta, pressed || !status.lacking.empty()))
    saver_->save(world.moment(), chunk_now(world.field()));
  complain(status);
}

/// Each failure once, in as many words as it has, and its end.
void SavedWorld::complain(const SaverStatus& status) {
  const std::string now = status.health.because.value_or("");
  if (now == complaint_) return;
  complaint_ = now;
  const auto more = log_.admit(now.empty() ? "saved again" : "not saved", steady_now_s());
  if (!more) return;
  if (temporary_ && !now.empty())
    log_of(LogPart::store)
        .warn(
            "terrain cannot leave memory, which is tried again: edits are refused once it is full "
            "(memory-max); "
            "give the server a folder with room (XDG_CACHE_HOME), or a world to keep (--world): {}{}",
            now, *more);
  else if (now.empty())
    log_of(LogPart::store).info("the world is saved again, up to tick {}{}", status.saved_tick, *more);
  else
    log_of(LogPart::store)
        .warn("the world is not saved since tick {}, and is tried again: {}{}", status.saved_tick, now,
              *more);
}

void SavedWorld::abandon() {
  saver_->end();
}

Result<void> SavedWorld::finish(World& world) {
  if (temporary_) {
    abandon();
    return {};
  }
  const Result<void> finished = saver_->finish(world.moment(), chunk_now(world.field()));
  const SaverStatus status = saver_->status();
  if (finished && !status.health.ok())
    log_of(LogPart::store)
        .info("{}: nothing has changed since tick {}, which the file holds, so nothing is lost: {}", path_,
              status.saved_tick, *status.health.because);
  else
    complain(status);
  tell_log_left();
  return finished;
}

/// A copy that is made now needs both files.
void SavedWorld::tell_log_left() const {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(path_ + "-wal", none);
  if (!none && bytes > 0)
    log_of(LogPart::store).warn("{0}-wal is left beside {0}, and has its newest rows: copy both", path_);
}

}  // namespace scree
