#include "server/store/recording_writer.h"

#include <cmath>
#include <set>
#include <utility>

#include "proto/event_codec.h"
#include "proto/world_codec.h"
#include "server/store/database.h"
#include "server/store/event_deriver.h"
#include "server/store/limits.h"
#include "server/store/recording_reader.h"
#include "server/store/schema.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/thread_check.h"

namespace scree {

namespace {

/// Ticks of one row of durations: a second of them at 60 Hz.
constexpr size_t ticks_per_machine_row = 60;
static_assert(ticks_per_machine_row <= limits::ticks_per_row_max);
constexpr double us_per_ms = 1000.0;

}  // namespace

struct RecordingWriter::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> begin();
  Result<void> found(const RecordingHeader& header);
  Result<void> prepare();
  Result<void> put_start(const RecordingStart& start);
  Result<void> put_keyframe(const TickDelta& delta);
  Result<void> put_short_keyframe();
  Result<void> put_events(const TickDelta& delta, std::span<const Event> noted);
  Result<void> put_machine();
  void forget_terrain();

  Database database;
  Statement insert_frame;
  Statement put_keyframe_row;
  Statement insert_commands;
  Statement insert_events;
  Statement put_machine_row;
  Statement put_short_keyframe_row;
  std::set<BrickCoord> changed;  ///< since the last keyframe
  std::optional<EventDeriver> deriver;
  RecordedMachine machine;         ///< since its last row
  bool logs = false;               ///< it has a row of the machine's from this process
  PublishedState published;        ///< after the last tick that was added
  bool terrain_forgotten = false;  ///< there are no more keyframes: seeking starts from an earlier one
  bool in_transaction = false;
  ThreadCheck storage_thread;
};

Result<void> RecordingWriter::State::begin() {
  if (in_transaction) return {};
  auto begun = database.execute("BEGIN IMMEDIATE");
  in_transaction = begun.has_value();
  return begun;
}

/// The tables and the header of a new file.
Result<void> RecordingWriter::State::found(const RecordingHeader& header) {
  if (auto done = database.execute("PRAGMA page_size = 16384; PRAGMA journal_mode = WAL;"); !done)
    return done;
  if (auto done = database.execute("BEGIN;" + schema::create_tables()); !done) return done;
  auto insert_header = database.prepare(schema::insert_into("header"));
  if (!insert_header) return tl::unexpected(insert_header.error());
  const std::vector<uint8_t> bytes = encode(to_recorded(header));
  if (auto done = database.put(*insert_header, 0, bytes); !done) return done;
  return database.execute("COMMIT");
}

Result<void> RecordingWriter::State::prepare() {
  const std::string settings =
      "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = " +
      std::to_string(limits::wal_pages_max) + ";";
  if (auto done = database.execute(settings); !done) return done;
  const auto take = [this](Statement& statement, const std::string& sql) -> Result<void> {
    auto prepared = database.prepare(sql);
    if (!prepared) return tl::unexpected(prepared.error());
    statement = std::move(*prepared);
    return {};
  };
  if (auto done = take(insert_frame, schema::insert_into("frames")); !done) return done;
  if (auto done = take(put_keyframe_row, schema::put_into("keyframes")); !done) return done;
  if (auto done = take(insert_commands, schema::insert_into("commands")); !done) return done;
  if (auto done = take(insert_events, schema::insert_into("events")); !done) return done;
  if (auto done = take(put_machine_row, schema::put_into("machine")); !done) return done;
  return take(put_short_keyframe_row, schema::put_into("short_keyframes"));
}

Result<void> RecordingWriter::State::put_keyframe(const TickDelta& delta) {
  const std::vector<uint8_t> keyframe = encode(to_recorded_keyframe(delta));
  // A keyframe too large for a row is left out: seeking starts from an earlier one.
  if (keyframe.size() > limits::row_bytes_max) return {};
  CHECK_DEBUG(decode_recorded_keyframe(keyframe).has_value());
  changed.clear();
  return database.put(put_keyframe_row, delta.tick, keyframe);
}

/// Where nothing has changed, the last keyframe does.
Result<void> RecordingWriter::State::put_short_keyframe() {
  if (changed.size() > limits::short_keyframe_bricks_max) return {};
  if (changed.empty() && published.pieces().empty()) return {};
  const std::vector<uint8_t> keyframe = encode(to_recorded_keyframe(published.as_delta(changed)));
  if (keyframe.size() > limits::row_bytes_max) return {};
  return database.put(put_short_keyframe_row, published.tick(), keyframe);
}

/// A row of the machine's is not written at each tick: it would be most of a quiet recording.
Result<void> RecordingWriter::State::put_events(const TickDelta& delta, std::span<const Event> noted) {
  CHECK(deriver.has_value());
  if (const std::vector<Event> events = deriver->events_of(delta); !events.empty())
    if (auto put = database.put(insert_events, delta.tick, encode(std::span(events))); !put) return put;
  machine.tick = delta.tick;
  machine.tick_us.push_back(static_cast<uint32_t>(std::lround(delta.times.total_ms() * us_per_ms)));
  for (const Event& event : noted)
    if (machine.events.size() < limits::events_per_row_max) machine.events.push_back(event);
  // The first one says at once where the log of events begins.
  const bool due = !logs || machine.tick_us.size() >= ticks_per_machine_row;
  logs = true;
  return due ? put_machine() : Result<void>();
}

Result<void> RecordingWriter::State::put_machine() {
  if (machine.tick_us.empty()) return {};
  const RecordedMachine row = std::exchange(machine, {});
  return database.put(put_machine_row, row.tick, encode(row));
}

/// When it is more than a recording may keep in memory; from then on always.
void RecordingWriter::State::forget_terrain() {
  if (published.bricks_in() > limits::recorded_bricks_max) terrain_forgotten = true;
  if (!terrain_forgotten) return;
  const std::vector<ChunkCoord> in(published.chunks_in().begin(), published.chunks_in().end());
  for (const ChunkCoord chunk : in) published.page_out(chunk);
}

/// The state, and the keyframe from which a replay begins there.
Result<void> RecordingWriter::State::put_start(const RecordingStart& start) {
  const std::vector<uint8_t> value = encode(start.value);
  if (value.size() > limits::row_bytes_max)
    return fail(database.path() + ": the world takes " + std::to_string(value.size()) +
                " bytes, too many for one row of a recording (limits.row_bytes_max)");
  if (auto begun = begin(); !begun) return begun;
  auto insert = database.prepare(schema::put_into("states"));
  if (!insert) return tl::unexpected(insert.error());
  if (auto put = database.put(*insert, start.keyframe.tick, value); !put) return put;
  published = {};
  published.apply(start.keyframe);
  deriver.emplace(start.value.moment.config.terrain.voxel_size_m, start.keyframe.settings);
  return put_keyframe(start.keyframe);
}

namespace {

bool alike(const WorldConfig& a, const WorldConfig& b) {
  return is_same_terrain(a, b) && a.tick_rate_hz == b.tick_rate_hz &&
         a.merges_per_tick_max == b.merges_per_tick_max;
}

/// The hash of the recorded world after the tick, which is the one before the first at least; nothing when it
/// was not recorded.
Result<std::optional<uint64_t>> hash_after(RecordingReader& recorded, Tick tick) {
  if (tick >= recorded.first_tick()) {
    const auto frame = recorded.frame(tick);
    if (!frame) return tl::unexpected(frame.error());
    return std::optional(frame->state_hash);
  }
  const auto keyframe = recorded.keyframe_before(tick);
  if (!keyframe) return tl::unexpected(keyframe.error());
  if (!keyframe->has_value() || (*keyframe)->tick != tick) return std::optional<uint64_t>();
  return std::optional((*keyframe)->state_hash);
}

/// Whether the recording is of this world, and reaches to the tick.
Result<void> may_resume(const std::string& path, const RecordingHeader& header, const TickDelta& start) {
  const Tick tick = start.tick;
  const auto recorded = RecordingReader::open(path);
  if (!recorded) return tl::unexpected(recorded.error());
  const auto another = fail(path + " is the recording of another world: choose another name (--record)");
  if (!alike((*recorded)->header().world, header.world)) return another;
  if ((*recorded)->last_tick() < tick || (*recorded)->first_tick() > tick + 1)
    return fail(path + " holds the ticks " + std::to_string((*recorded)->first_tick()) + " to " +
                std::to_string((*recorded)->last_tick()) + ", and the world stands at " +
                std::to_string(tick) + ": choose another name (--record)");
  const auto hash = hash_after(**recorded, tick);
  if (!hash) return tl::unexpected(hash.error());
  // Before its first tick a world is what its configuration says.
  const bool same = *hash ? **hash == start.state_hash : tick == 0;
  if (!same) return another;
  return {};
}

}  // namespace

RecordingWriter::RecordingWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

RecordingWriter::~RecordingWriter() {
  static_cast<void>(commit());
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 const RecordingHeader& header) {
  auto database = Database::create(path);
  if (!database) return tl::unexpected(database.error());
  auto state = std::make_unique<State>(std::move(*database));
  if (auto done = state->found(header); !done) return tl::unexpected(done.error());
  state->deriver.emplace(header.world.terrain.voxel_size_m, print(header.world));
  if (auto prepared = state->prepare(); !prepared) return tl::unexpected(prepared.error());
  return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(state)));
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 const RecordingHeader& header,
                                                                 const RecordingStart& start) {
  auto writer = create(path, header);
  if (!writer) return writer;
  if (auto put = (*writer)->state_->put_start(start); !put) return tl::unexpected(put.error());
  return writer;
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::resume(const std::string& path,
                                                                 const RecordingHeader& header,
                                                                 const RecordingStart& start) {
  const Tick tick = start.keyframe.tick;
  if (auto fits = may_resume(path, header, start.keyframe); !fits) return tl::unexpected(fits.error());
  auto database = Database::open(path);
  if (!database) return tl::unexpected(database.error());
  auto state = std::make_unique<State>(std::move(*database));
  if (auto made = state->database.execute(schema::create_later_tables()); !made)
    return tl::unexpected(made.error());
  if (auto prepared = state->prepare(); !prepared) return tl::unexpected(prepared.error());
  if (auto begun = state->begin(); !begun) return tl::unexpected(begun.error());
  for (const char* table :
       {"frames", "keyframes", "commands", "states", "events", "machine", "short_keyframes"})
    if (auto done = state->database.execute(std::string("DELETE FROM ") + table + " WHERE tick > " +
                                            std::to_string(tick));
        !done)
      return tl::unexpected(done.error());
  if (auto put = state->put_start(start); !put) return tl::unexpected(put.error());
  return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(state)));
}

Result<void> RecordingWriter::add(const TickDelta& delta, std::span<const Command> commands,
                                  std::span<const Event> noted) {
  State& state = *state_;
  CHECK(state.storage_thread.is_the_same());
  if (auto begun = state.begin(); !begun) return begun;
  if (!commands.empty()) {
    const std::vector<uint8_t> recorded = encode(to_recorded(commands));
    if (auto put = state.database.put(state.insert_commands, delta.tick, recorded); !put) return put;
  }
  // After its commands: by the frames a recording says how far it goes, also after an error.
  const std::vector<uint8_t> frame = encode(to_recorded(delta, state.published));
  CHECK_DEBUG(decode_recorded_frame(frame).has_value());
  if (auto put = state.database.put(state.insert_frame, delta.tick, frame); !put) return put;
  if (auto put = state.put_events(delta, noted); !put) return put;
  state.published.apply(delta);
  state.forget_terrain();
  if (state.terrain_forgotten) return {};
  for (const BrickState& brick : delta.bricks) state.changed.insert(brick.coord);
  if (delta.tick % limits::ticks_per_keyframe == 0) return state.put_keyframe(state.published.as_delta());
  return delta.tick % limits::ticks_per_short_keyframe == 0 ? state.put_short_keyframe() : Result<void>();
}

Result<void> RecordingWriter::commit() {
  if (!state_->in_transaction) return {};
  state_->in_transaction = false;
  return state_->database.execute("COMMIT");
}

Result<void> RecordingWriter::finish() {
  if (!state_->machine.tick_us.empty()) {
    if (auto begun = state_->begin(); !begun) return begun;
    if (auto put = state_->put_machine(); !put) return put;
  }
  if (auto committed = commit(); !committed) return committed;
  CHECK(!state_->in_transaction);
  return state_->database.execute("PRAGMA journal_mode = DELETE");
}

}  // namespace scree
