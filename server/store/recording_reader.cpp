#include "server/store/recording_reader.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "server/formats/world_codec.h"
#include "server/store/database.h"
#include "server/store/event_reader.h"
#include "server/store/file_kind.h"
#include "server/store/limits.h"
#include "server/store/schema.h"
#include "server/world/settings.h"
#include "shared/base/check.h"

namespace scree {

struct RecordingReader::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> read_header();
  Result<void> hold();
  Result<void> read_extent(WithoutTicks without_ticks);
  Result<void> supply_missing_tables();
  Result<void> open_readers();
  Result<std::optional<Tick>> state_up_to(Tick tick);
  Result<void> read_end();
  tl::unexpected<Error> missing(Tick tick);
  template <typename T>
  Result<T> decoded(Result<T> result, Tick tick) const;

  Database database;
  RecordingHeader header;
  Tick first_tick = 1;
  Tick last_tick = 0;
  uint64_t keyframes = 0;
  uint64_t bytes = 0;
  bool is_ended = false;
  bool holds = false;        ///< a transaction, which sees one moment
  bool without_log = false;  ///< it was open for writing when it was left, or copied
  Statement select_frame;
  Statement select_commands;
  Statement select_moment;
  std::optional<KeyframeReader> keyframe_rows;
  std::optional<EventReader> events;
};

Result<void> RecordingReader::State::read_header() {
  auto select = TRY(database.prepare(schema::select_from("header")));
  const auto bytes_read = TRY(database.get(select, 0));
  if (!bytes_read.has_value()) return fail(database.path() + ": damaged: it has no header");
  const auto recorded = decode_recorded_header(*bytes_read);
  if (!recorded) return fail(fmt::format("{}: damaged: {}", database.path(), recorded.error().message));
  if (!reads_recording_format(recorded->format))
    return fail(fmt::format("{}: damaged: its header is of format {}", database.path(), recorded->format));
  auto understood = from_recorded(*recorded);
  if (!understood)
    return fail(fmt::format("{}: made by another release: {}", database.path(), understood.error().message));
  header = std::move(*understood);
  return {};
}

/// Without SQLite's log nobody writes, and who begins to would be kept out.
Result<void> RecordingReader::State::hold() {
  if (holds || is_ended) return {};
  const auto journal = TRY(database.text("PRAGMA journal_mode"));
  if (journal != "wal") return {};
  auto begun = database.execute("BEGIN", "cannot be read");
  holds = begun.has_value();
  return begun;
}

Result<void> RecordingReader::State::read_extent(WithoutTicks without_ticks) {
  const auto first = database.number("SELECT min(tick) FROM frames");
  const auto last = database.number("SELECT max(tick) FROM frames");
  const auto count = database.number("SELECT count(*) FROM frames");
  for (const auto* number : {&first, &last, &count})
    if (!*number) return tl::unexpected(number->error());
  const auto rows = TRY(keyframe_rows->count());
  if (!first->has_value() && without_ticks == WithoutTicks::awaited && !is_ended) return {};
  if (!first->has_value()) return fail(database.path() + ": the recording holds no tick");
  if (**first < 1) return fail(fmt::format("{}: damaged: it begins at tick {}", database.path(), **first));
  const auto begun = TRY(state_up_to(static_cast<Tick>(**first - 1)));
  if (*first != 1 && begun.has_value() && static_cast<Tick>(**first) - 1 - *begun > limits::unseen_ticks_max)
    return fail(fmt::format(
        "{}: damaged: its first tick is {}, too far from its state after tick {} (limits.unseen_ticks_max)",
        database.path(), **first, *begun));
  if ((*first != 1 && !begun.has_value()) || **last - **first != **count - 1)
    return fail(fmt::format("{}: damaged: ticks are missing ({} from {} to {})", database.path(), **count,
                            **first, **last));
  first_tick = static_cast<Tick>(**first);
  last_tick = static_cast<Tick>(**last);
  keyframes = rows;
  return {};
}

/// Makes an empty table in memory for each one that the file lacks. Rows are read afterwards.
Result<void> RecordingReader::State::supply_missing_tables() {
  const auto supply = [this](const char* table) -> Result<void> {
    const auto has = TRY(database.has_table(table));
    return has ? Result<void>() : database.execute(schema::create_empty(table), "cannot be read");
  };
  for (const char* table : schema::row_tables) TRY(supply(table));
  return supply(schema::chunk_table);
}

Result<void> RecordingReader::State::open_readers() {
  auto rows = TRY(KeyframeReader::open(database, print(header.world)));
  keyframe_rows = std::move(rows);
  auto log = TRY(EventReader::open(database));
  events = std::move(log);
  for (const auto& [statement, table] :
       {std::pair(&select_frame, "frames"), std::pair(&select_commands, "commands"),
        std::pair(&select_moment, "state_moments")}) {
    auto prepared = TRY(database.prepare(schema::select_from(table)));
    *statement = std::move(prepared);
  }
  return {};
}

/// A recorder that came to its end has merged its log, or has left a row that says so.
Result<void> RecordingReader::State::read_end() {
  const auto journal = database.text("PRAGMA journal_mode");  // RecordingWriter::finish() sets "delete"
  TRY(journal);
  is_ended = *journal != "wal";
  if (is_ended) return {};
  const auto row = TRY(database.number("SELECT count(*) FROM ended"));
  is_ended = row != 0;
  return {};
}

/// A decoder's refusal, with the file and the tick in front.
template <typename T>
Result<T> RecordingReader::State::decoded(Result<T> result, Tick tick) const {
  if (result) return result;
  return fail(fmt::format("{}: damaged at tick {}: {}", database.path(), tick, result.error().message));
}

RecordingReader::RecordingReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordingReader::~RecordingReader() = default;

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::string& path,
                                                               WithoutTicks without_ticks) {
  const bool without_log = lacks_log(path, schema::recording);
  auto opened = open_as_it_lies(path, without_ticks);
  if (!opened && without_log) return fail(opened.error().message + missing_log_hint(path));
  if (opened) (*opened)->state_->without_log = without_log;
  return opened;
}

Result<std::unique_ptr<RecordingReader>> RecordingReader::open_as_it_lies(const std::string& path,
                                                                          WithoutTicks without_ticks) {
  TRY(check_file(path, schema::recording));
  auto database = TRY(Database::open(path));
  auto state = std::make_unique<State>(std::move(database));
  TRY(check_format(state->database, schema::recording));
  TRY(state->database.execute("PRAGMA temp_store = MEMORY",
                              "cannot be read"));  // for supply_missing_tables()
  TRY(state->hold());
  TRY(check_pages(state->database));
  TRY(state->supply_missing_tables());
  TRY(state->read_header());
  TRY(state->open_readers());
  TRY(state->read_end());
  TRY(state->read_extent(without_ticks));
  std::error_code ignored;
  state->bytes = std::filesystem::file_size(path, ignored);
  if (const auto log = std::filesystem::file_size(path + "-wal", ignored); !ignored) state->bytes += log;
  return std::unique_ptr<RecordingReader>(new RecordingReader(std::move(state)));
}

const std::string& RecordingReader::path() const {
  return state_->database.path();
}
const RecordingHeader& RecordingReader::header() const {
  return state_->header;
}
Tick RecordingReader::first_tick() const {
  return state_->first_tick;
}
Tick RecordingReader::last_tick() const {
  return state_->last_tick;
}
uint64_t RecordingReader::keyframes() const {
  return state_->keyframes;
}
bool RecordingReader::is_ended() const {
  return state_->is_ended;
}
bool RecordingReader::may_lack_ticks() const {
  return state_->without_log && !state_->is_ended;
}
Result<void> RecordingReader::refresh() {
  State& state = *state_;
  if (state.is_ended) return {};
  let_go();
  TRY(state.hold());
  TRY(state.read_end());
  const auto first = state.database.number("SELECT min(tick) FROM frames");
  const auto last = state.database.number("SELECT max(tick) FROM frames");
  for (const auto* number : {&first, &last})
    if (!*number) return tl::unexpected(number->error());
  if (last->value_or(0) < static_cast<int64_t>(state.last_tick))
    return fail(
        fmt::format("{}: its ticks after {} are gone, because its world was rolled back: open it again",
                    path(), last->value_or(0)));
  if (!first->has_value()) return {};
  const Tick before = std::exchange(state.first_tick, static_cast<Tick>(**first));
  state.last_tick = static_cast<Tick>(**last);
  if (state.first_tick > before) state.keyframe_rows->forget_before(state.first_tick - 1);
  return state.events->find_start();
}

void RecordingReader::let_go() {
  if (std::exchange(state_->holds, false)) static_cast<void>(state_->database.execute("COMMIT"));
}

uint64_t RecordingReader::bytes() const {
  return state_->bytes;
}

/// The terrain is that of its tick's keyframe.
Result<std::optional<WorldSnapshot>> RecordingReader::state(Tick tick) {
  const auto row = TRY(state_->database.get(state_->select_moment, tick));
  if (!row.has_value()) return std::optional<WorldSnapshot>();
  auto value = TRY(state_->decoded(decode_world(*row), tick));
  const auto at = TRY(state_->keyframe_rows->tick_before(tick));
  if (at != tick) return fail(fmt::format("{}: damaged: the state of tick {} has no terrain", path(), tick));
  if (!value.bricks.empty())
    return fail(fmt::format("{}: damaged: the state of tick {} has bricks", path(), tick));
  return std::optional(std::move(value));
}

Result<void> RecordingReader::each_chunk(Tick tick, const KeyframeReader::ChunkVisitor& visit) {
  return state_->keyframe_rows->each_chunk(tick, visit);
}

Result<bool> RecordingReader::has_chunk(ChunkCoord chunk, uint64_t hash, Tick tick) {
  return state_->keyframe_rows->has_chunk(chunk, hash, tick);
}

Result<std::vector<BrickPatch>> RecordingReader::chunk(ChunkCoord chunk, uint64_t hash) {
  return state_->keyframe_rows->chunk(chunk, hash);
}

Result<std::optional<Tick>> RecordingReader::State::state_up_to(Tick tick) {
  const auto row = TRY(database.number(
      fmt::format("SELECT max(tick) FROM state_moments WHERE tick >= 0 AND tick <= {}", tick)));
  return row.has_value() ? std::optional(static_cast<Tick>(*row)) : std::nullopt;
}

Result<Tick> RecordingReader::state_before(Tick tick) {
  const auto latest = TRY(state_->state_up_to(tick));
  return latest.value_or(0);
}

Result<Tick> RecordingReader::keyframe_tick_before(Tick tick) {
  const auto at = TRY(state_->keyframe_rows->tick_before(tick));
  return at.value_or(0);
}

/// A ring that was gone on with, after it had been opened, may have dropped it.
tl::unexpected<Error> RecordingReader::State::missing(Tick tick) {
  const auto first = database.number("SELECT min(tick) FROM frames");
  if (first && first->value_or(0) > static_cast<int64_t>(tick))
    return fail(fmt::format(
        "{}: its ring moved past tick {} while it was read, and begins at tick {} now: read it again",
        database.path(), tick, **first));
  return fail(fmt::format("{}: damaged: tick {} is missing", database.path(), tick));
}

Result<RecordedFrame> RecordingReader::frame(Tick tick) {
  CHECK(tick >= state_->first_tick && tick <= state_->last_tick);
  const auto bytes = TRY(state_->database.get(state_->select_frame, tick));
  if (!bytes.has_value()) return state_->missing(tick);
  auto frame = state_->decoded(decode_recorded_frame(*bytes), tick);
  if (frame && frame->tick != tick)
    return fail(
        fmt::format("{}: damaged: the frame of tick {} says that it is tick {}", path(), tick, frame->tick));
  return frame;
}

Result<std::vector<Command>> RecordingReader::commands(Tick tick) {
  CHECK(tick <= state_->last_tick);
  const auto bytes = TRY(state_->database.get(state_->select_commands, tick));
  if (!bytes.has_value()) return std::vector<Command>();
  const auto recorded = TRY(state_->decoded(decode_recorded_commands(*bytes), tick));
  return recorded;
}

std::optional<Tick> RecordingReader::events_from() const {
  return state_->events->from();
}

Result<std::vector<Event>> RecordingReader::events(Tick tick) {
  return events(tick, tick);
}

Result<std::vector<Event>> RecordingReader::events(Tick from, Tick to) {
  return state_->events->events(from, to);
}

Result<std::vector<RecordedMachine>> RecordingReader::machine(Tick from, Tick to) {
  return state_->events->machine(from, to);
}

Result<std::optional<Tick>> RecordingReader::next_event(Tick tick) {
  return state_->events->next(tick, state_->last_tick);
}

Result<std::optional<Tick>> RecordingReader::previous_event(Tick tick) {
  return state_->events->previous(tick, state_->first_tick);
}

Result<std::optional<RecordedKeyframe>> RecordingReader::keyframe_before(Tick tick) {
  auto parts = TRY(keyframe_before(tick, KnownParts()));
  if (!parts.has_value()) return std::optional<RecordedKeyframe>();
  return std::optional(std::move(parts->keyframe));
}

Result<std::optional<KeyframeParts>> RecordingReader::keyframe_before(Tick tick, const KnownParts& known) {
  CHECK(tick <= state_->last_tick);
  const auto at = TRY(state_->keyframe_rows->tick_before(tick));
  if (!at) return std::optional<KeyframeParts>();
  auto parts = TRY(state_->keyframe_rows->read(*at, known));
  return std::optional(std::move(parts));
}

}  // namespace scree
