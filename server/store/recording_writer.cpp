#include "server/store/recording_writer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "server/formats/event_codec.h"
#include "server/formats/world_codec.h"
#include "server/store/database.h"
#include "server/store/event_deriver.h"
#include "server/store/keyframe_tables.h"
#include "server/store/keyframe_writer.h"
#include "server/store/limits.h"
#include "server/store/machine_writer.h"
#include "server/store/resumed_recording.h"
#include "server/store/schema.h"
#include "server/store/store_fault.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/thread_check.h"

namespace scree {

struct RecordingWriter::State {
  State(Database d, RecordingHeader h, RingLimit l)
      : database(std::move(d)), header(std::move(h)), ring(l, header.world.tick_rate_hz), limit(l) {}
  Result<void> begin();
  Result<void> found();
  Result<void> prepare();
  Result<void> put_start(const RecordingStart& start);
  Result<void> put_tick(const TickDelta& delta, std::span<const Command> commands,
                        std::span<const Event> noted, const WorldMoment* part,
                        const std::optional<std::vector<PlayerCursor>>& cursors);
  void abandon();
  Result<void> put_commands(Tick tick, std::span<const Command> commands);
  Result<void> put_part(const WorldMoment& moment);
  Result<void> put_events(const TickDelta& delta);
  Result<void> put_end();
  Result<void> drop_parts();
  Result<void> drop_before(RecordingRing::Part part);
  Result<void> count_bytes();
  Result<void> measure();
  void begin_events(const SettingValues& settings) {
    deriver.emplace(header.world.terrain.voxel_size_m, settings, header.merge_burst_ticks, header.contacts_j);
  }

  Database database;
  const RecordingHeader header;
  Statement insert_frame;
  Statement insert_commands;
  Statement insert_events;
  Statement put_moment;
  std::optional<KeyframeTables> tables;
  std::optional<KeyframeWriter> keyframes;
  std::optional<EventDeriver> deriver;
  std::optional<MachineWriter> machine;
  PublishedState published;  ///< after the last tick that was added
  RecordingRing ring;
  const RingLimit limit;
  uint64_t bytes = 0;  ///< of the pages of the file that are in use, at the last commit; of a ring alone
  RecordingSize size;
  bool in_transaction = false;
  bool spoiled = false;
  bool dropped = false;  ///< a part
  ThreadCheck storage_thread;
};

Result<void> RecordingWriter::State::begin() {
  if (in_transaction) return {};
  auto begun = database.execute("BEGIN IMMEDIATE");
  in_transaction = begun.has_value();
  return begun;
}

/// The tables and the header of a new file.
Result<void> RecordingWriter::State::found() {
  if (auto done = database.execute(
          fmt::format("PRAGMA page_size = {}; PRAGMA journal_mode = WAL;", limits::recording_page_bytes));
      !done)
    return done;
  if (auto done = database.execute("BEGIN;" + schema::create_tables()); !done) return done;
  auto insert_header = TRY(database.prepare(schema::insert_into("header")));
  const std::vector<uint8_t> bytes = encode(to_recorded(header));
  TRY(database.put(insert_header, 0, bytes));
  return database.execute("COMMIT");
}

Result<void> RecordingWriter::State::prepare() {
  const uint64_t log_bytes = limit.log_bytes();
  const std::string settings = fmt::format(
      "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = {}; PRAGMA "
      "journal_size_limit = {};",
      std::max<uint64_t>(1, log_bytes / limits::recording_page_bytes), log_bytes);
  TRY(database.execute(settings));
  const auto prepare = [this](Statement& statement, const std::string& sql) -> Result<void> {
    auto prepared = TRY(database.prepare(sql));
    statement = std::move(prepared);
    return {};
  };
  TRY(prepare(insert_frame, schema::insert_into("frames")));
  TRY(prepare(insert_commands, schema::insert_into("commands")));
  TRY(prepare(insert_events, schema::insert_into("events")));
  TRY(prepare(put_moment, schema::put_into("state_moments")));
  tables.emplace(TRY(KeyframeTables::create(database)));
  keyframes.emplace(*tables, print(header.world));
  auto rows = TRY(MachineWriter::create(database));
  machine = std::move(rows);
  return {};
}

Result<void> RecordingWriter::State::put_events(const TickDelta& delta) {
  CHECK(deriver.has_value());
  const std::vector<Event> events = deriver->events_of(delta);
  return events.empty() ? Result<void>() : database.put(insert_events, delta.tick, encode(std::span(events)));
}

Result<void> RecordingWriter::State::put_commands(Tick tick, std::span<const Command> commands) {
  if (commands.empty()) return {};
  return database.put(insert_commands, tick, encode(commands));
}

/// The state's keyframe with the world's value, from which the simulation goes on. Events begin anew there,
/// so that who verifies from there has the same.
Result<void> RecordingWriter::State::put_part(const WorldMoment& moment) {
  CHECK_EQ(moment.tick, published.tick());
  const std::vector<uint8_t> value = encode(WorldSnapshot{moment, {}});
  if (value.size() > limits::row_bytes_max)
    return fail(fmt::format(
        "{}: the world's pieces take {} bytes, too many for one row of a recording (limits.row_bytes_max)",
        database.path(), value.size()));
  TRY(keyframes->put(published));
  TRY(database.put(put_moment, moment.tick, value));
  begin_events(published.settings());
  machine->tell_persons();
  ring.begin({moment.tick, moment.next_piece}, bytes);
  return {};
}

Result<void> RecordingWriter::State::put_start(const RecordingStart& start) {
  TRY(begin());
  for (const Participant& person : start.persons) machine->note(person);
  keyframes->begin(start.keyframe, published, start.read);
  return put_part(start.moment);
}

Result<void> RecordingWriter::State::count_bytes() {
  uint64_t pages = 0, unused = 0, page_bytes = 0;
  const std::pair<uint64_t*, const char*> counts[] = {
      {&pages, "PRAGMA page_count"}, {&unused, "PRAGMA freelist_count"}, {&page_bytes, "PRAGMA page_size"}};
  for (const auto& [count, sql] : counts) {
    const auto number = database.number(sql);
    TRY(number);
    *count = static_cast<uint64_t>(number->value_or(0));
  }
  bytes = (pages - std::min(pages, unused)) * page_bytes;
  return {};
}

/// After a commit, when the log has been merged if it is long.
Result<void> RecordingWriter::State::measure() {
  if (database.has_moved())
    return fail(
        fmt::format("{}: {} while it was recorded (--record)", database.path(), name_of(StoreFault::moved)));
  const auto bytes_of = [](const std::string& path) {
    std::error_code none;
    const uint64_t found = std::filesystem::file_size(path, none);
    return none ? 0 : found;
  };
  size.file_bytes = bytes_of(database.path());
  size.log_bytes = bytes_of(database.path() + "-wal");
  size.over_limit = ring.over_limit(size, bytes);
  return {};
}

/// Those that the limit has no room for. Their pages are used again.
Result<void> RecordingWriter::State::drop_parts() {
  TRY(count_bytes());
  while (const RecordingRing::Part* first = ring.first_to_stay(published.tick(), bytes))
    TRY(drop_before(*first));
  return {};
}

Result<void> RecordingWriter::State::drop_before(const RecordingRing::Part part) {
  const std::string tick = std::to_string(part.tick);
  std::string sql;
  for (const char* table : {"frames", "commands", "events", "machine"})
    sql += fmt::format("DELETE FROM {} WHERE tick <= {};", table, tick);
  sql += fmt::format("DELETE FROM state_moments WHERE tick < {};", tick);
  TRY(database.execute(sql));
  TRY(tables->drop_before(part.tick, part.next_piece));
  TRY(count_bytes());
  ring.drop_before(part.tick, bytes);
  dropped = true;
  return {};
}

/// What the file has not of this object's state is not known any more.
void RecordingWriter::State::abandon() {
  spoiled = true;
  in_transaction = false;
  static_cast<void>(database.execute("ROLLBACK"));  // SQLite may have done so
}

RecordingWriter::RecordingWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

RecordingWriter::~RecordingWriter() {
  static_cast<void>(commit());
}

bool RecordingWriter::is_spoiled() const {
  return state_->spoiled;
}

void RecordingWriter::set_clock(std::function<uint64_t()> unix_ms) {
  state_->machine->set_clock(std::move(unix_ms));
}

void RecordingWriter::note(const Participant& person) {
  state_->machine->note(person);
  state_->machine->tell_persons();
}

bool RecordingWriter::has_dropped() const {
  return state_->dropped;
}

const std::string& RecordingWriter::path() const {
  return state_->database.path();
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 const RecordingHeader& header,
                                                                 RingLimit limit) {
  auto database = TRY(Database::create(path));
  auto state = std::make_unique<State>(std::move(database), header, limit);
  auto made = state->found();
  if (made) made = state->prepare();
  if (!made) {
    state.reset();
    remove_recording(path);
    return tl::unexpected(made.error());
  }
  state->begin_events(print(header.world));
  state->ring.begin({0, 0}, 0);
  return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(state)));
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 const RecordingHeader& header,
                                                                 const RecordingStart& start,
                                                                 RingLimit limit) {
  auto writer = create(path, header, limit);
  if (!writer) return writer;
  const auto begun = (*writer)->begin_with(start);
  if (begun) return writer;
  writer->reset();
  remove_recording(path);
  return tl::unexpected(begun.error());
}

Result<void> RecordingWriter::begin_with(const RecordingStart& start) {
  state_->ring.drop_before(start.keyframe.tick, 0);
  auto put = state_->put_start(start);
  if (!put) state_->abandon();
  return put;
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::resume(const std::string& path,
                                                                 const RecordingHeader& header,
                                                                 const RecordingStart& start,
                                                                 RingLimit limit) {
  const Tick tick = start.keyframe.tick;
  const auto recorded = TRY(header_to_resume(path, header, start.keyframe));
  auto database = TRY(Database::open(path));
  auto state = std::make_unique<State>(std::move(database), recorded, limit);
  TRY(state->database.execute(schema::create_tables()));
  TRY(state->prepare());
  TRY(state->begin());
  const std::string at = std::to_string(tick);
  std::string sql = fmt::format("DELETE FROM ended; DELETE FROM state_moments WHERE tick >= {};", at);
  for (const char* table : {"frames", "commands", "events", "machine", "keyframe_states", "keyframe_chunks"})
    sql += fmt::format("DELETE FROM {} WHERE tick > {};", table, at);
  TRY(state->database.execute(sql));
  TRY(state->tables->each_chunk(
      [&](ChunkCoord chunk, uint64_t hash) { state->keyframes->note_written(chunk, hash); }));
  state->ring.begin({0, 0}, 0);  // all that was there before
  TRY(state->count_bytes());
  TRY(state->put_start(start));
  return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(state)));
}

Result<void> RecordingWriter::add_unseen(Tick tick, std::span<const Command> commands) {
  TRY(state_->begin());
  return state_->put_commands(tick, commands);
}

Result<void> RecordingWriter::begin_at(const TickDelta& keyframe, ReadChunk read) {
  State& state = *state_;
  TRY(state.begin());
  state.keyframes->begin(keyframe, state.published, std::move(read));
  state.begin_events(keyframe.settings);
  return state.keyframes->put(state.published);
}

Result<void> RecordingWriter::State::put_tick(const TickDelta& delta, std::span<const Command> commands,
                                              std::span<const Event> noted, const WorldMoment* part,
                                              const std::optional<std::vector<PlayerCursor>>& at) {
  TRY(put_commands(delta.tick, commands));
  // After its commands: by the frames a recording says how far it goes, also after an error.
  const std::vector<uint8_t> frame = encode(to_recorded(delta, published));
  CHECK_DEBUG(decode_recorded_frame(frame).has_value());
  TRY(database.put(insert_frame, delta.tick, frame));
  TRY(put_events(delta));
  TRY(machine->add(delta, noted, at));
  TRY(keyframes->apply(delta, published));
  if (part != nullptr) return put_part(*part);
  return keyframes->is_due(published) ? keyframes->put(published) : Result<void>();
}

Result<void> RecordingWriter::add(const TickDelta& delta, std::span<const Command> commands,
                                  std::span<const Event> noted, const WorldMoment* part,
                                  const std::optional<std::vector<PlayerCursor>>& cursors) {
  State& state = *state_;
  CHECK(state.storage_thread.is_the_same());
  TRY(state.begin());  // while somebody else holds the file, nothing has changed here
  auto put = state.put_tick(delta, commands, noted, part, cursors);
  if (!put) state.abandon();
  return put;
}

PartWish RecordingWriter::wants_part() const {
  return state_->ring.wish(state_->published.tick(), state_->bytes);
}

Result<void> RecordingWriter::commit() {
  State& state = *state_;
  if (!state.in_transaction) return {};
  const auto done = [&]() -> Result<void> {
    if (state.limit.is_on()) TRY(state.drop_parts());
    TRY(state.database.execute("COMMIT"));
    state.in_transaction = false;
    return state.measure();
  }();
  if (!done) state.abandon();
  return done;
}

const RecordingSize& RecordingWriter::size() const {
  return state_->size;
}

Result<void> RecordingWriter::State::put_end() {
  auto put_row = TRY(database.prepare(schema::put_into("ended")));
  const std::array<uint8_t, 1> nothing_more{};
  return database.put(put_row, published.tick(), nothing_more);
}

Result<void> RecordingWriter::finish() {
  TRY(state_->begin());
  auto put = state_->machine->put();
  if (put) put = state_->put_end();
  if (!put) {
    state_->abandon();
    return put;
  }
  TRY(commit());
  CHECK(!state_->in_transaction);
  auto merged = state_->database.execute("PRAGMA journal_mode = DELETE");
  return merged || !Database::is_held(merged.error()) ? merged : Result<void>();
}

}  // namespace scree
