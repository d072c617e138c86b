#include "server/app/recorded_past.h"

#include <filesystem>

#include "crypto/signing_key.h"
#include "server/replay/recorded_world.h"
#include "server/store/stored_field.h"
#include "server/store/world_lock.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// Whether the world was recorded there, as far as both have its tick.
Result<void> check_recording(const WorldRows& rows, const std::string& path, RecordingReader& recording) {
  const WorldMoment& moment = rows.world.moment;
  const auto config = config_of(moment.config);
  if (!config) return fail(path + ": " + config.error().message);
  const auto other = fail(recording.path() + " is the recording of another world than " + path);
  if (!is_same_terrain(*config, recording.header().world)) return other;
  if (moment.tick < recording.first_tick() || moment.tick > recording.last_tick()) return {};
  const auto frame = recording.frame(moment.tick);
  TRY(frame);
  if (frame->state_hash != moment.state_hash) return other;
  return {};
}

Result<void> write_world(const std::string& path, WorldHeader header, World& world) {
  header.config = world.moment().config;
  header.config.program = "scree-world " SCREE_VERSION;
  return create_world(path, header, world);
}

/// The old file gets a second name before the new one takes its first: at any moment one of both has it.
Result<void> exchange(const std::string& path, const std::string& made, const std::string& before) {
  std::error_code error;
  if (fs::exists(path + "-wal", error))
    return fail(path + " has a log that is not merged: another program reads it");
  fs::create_hard_link(path, before, error);
  if (!error) fs::rename(made, path, error);
  return error ? fail(path + " cannot be replaced: " + error.message()) : Result<void>();
}

}  // namespace

Result<PastWorld> world_of_recording(const std::string& path, const std::string& recording,
                                     std::optional<Tick> tick, const GroundGiver& ground) {
  const auto lock = TRY(WorldLock::acquire(path));
  const auto reader = TRY(RecordingReader::open(recording));
  RecordedTerrain terrain(*reader);
  const auto world = TRY(simulated_to(*reader, tick.value_or(reader->last_tick()), terrain, ground));
  const WorldHeader header{.world = std::max<uint64_t>(1, random_number()), .config = {}};
  TRY(write_world(path, header, *world));
  return PastWorld{world->tick(), {}};
}

Result<PastWorld> roll_back(const std::string& path, const std::string& recording, Tick tick,
                            const GroundGiver& ground) {
  const auto lock = TRY(WorldLock::acquire(path));
  const std::string made = path + "-past", before = path + "-before-" + std::to_string(tick);
  std::error_code error;
  if (fs::exists(before, error)) return fail(before + " exists already: move it away");
  const auto reader = TRY(RecordingReader::open(recording));
  WorldHeader header;
  {
    const auto file = TRY(WorldFile::open(path));
    const auto rows = TRY(file->read_moment());
    TRY(check_recording(rows, path, *reader));
    header = rows.header;
  }
  RecordedTerrain terrain(*reader);
  const auto world = TRY(simulated_to(*reader, tick, terrain, ground));
  fs::remove(made, error);
  TRY(write_world(made, header, *world));
  TRY(exchange(path, made, before));
  return PastWorld{tick, before};
}

}  // namespace scree
