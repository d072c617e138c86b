#include "server/store/recording_reader.h"

#include <filesystem>

#include "server/store/database.h"
#include "server/store/file_kind.h"
#include "server/store/schema.h"
#include "shared/base/check.h"

namespace scree {

struct RecordingReader::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> read_header();
  Result<void> read_extent();
  template <typename T>
  Result<T> decoded(Result<T> result, Tick tick) const;

  Database database;
  RecordingHeader header;
  Tick first_tick = 1;
  Tick last_tick = 0;
  uint64_t keyframes = 0;
  uint64_t bytes = 0;
  Statement select_frame;
  Statement select_keyframe;
  Statement select_commands;
  Statement select_state;
};

Result<void> RecordingReader::State::read_header() {
  auto select = database.prepare(schema::select_from("header"));
  if (!select) return tl::unexpected(select.error());
  const auto bytes_read = database.get(*select, 0);
  if (!bytes_read) return tl::unexpected(bytes_read.error());
  if (!bytes_read->has_value()) return fail(database.path() + ": damaged: it has no header");
  const auto recorded = decode_recorded_header(**bytes_read);
  if (!recorded) return fail(database.path() + ": damaged: " + recorded.error().message);
  if (recorded->format != recording_format)
    return fail(database.path() + ": damaged: its header is of format " + std::to_string(recorded->format));
  auto understood = from_recorded(*recorded);
  if (!understood) return fail(database.path() + ": made by another release: " + understood.error().message);
  header = std::move(*understood);
  return {};
}

Result<void> RecordingReader::State::read_extent() {
  const auto first = database.number("SELECT min(tick) FROM frames");
  const auto last = database.number("SELECT max(tick) FROM frames");
  const auto count = database.number("SELECT count(*) FROM frames");
  const auto keys = database.number("SELECT count(*) FROM keyframes");
  for (const auto* number : {&first, &last, &count, &keys})
    if (!*number) return tl::unexpected(number->error());
  if (!first->has_value()) return fail(database.path() + ": the recording holds no tick");
  if (**first < 1) return fail(database.path() + ": damaged: it begins at tick " + std::to_string(**first));
  const auto begun =
      database.number("SELECT count(*) FROM states WHERE tick = " + std::to_string(**first - 1));
  if (!begun) return tl::unexpected(begun.error());
  if ((*first != 1 && *begun != 1) || **last - **first != **count - 1)
    return fail(database.path() + ": damaged: ticks are missing (" + std::to_string(**count) + " from " +
                std::to_string(**first) + " to " + std::to_string(**last) + ")");
  first_tick = static_cast<Tick>(**first);
  last_tick = static_cast<Tick>(**last);
  keyframes = static_cast<uint64_t>(keys->value_or(0));
  return {};
}

/// A decoder's refusal, with the file and the tick in front.
template <typename T>
Result<T> RecordingReader::State::decoded(Result<T> result, Tick tick) const {
  if (result) return result;
  return fail(database.path() + ": damaged at tick " + std::to_string(tick) + ": " + result.error().message);
}

RecordingReader::RecordingReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordingReader::~RecordingReader() = default;

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::string& path) {
  if (auto looks = check_file(path, schema::recording); !looks) return tl::unexpected(looks.error());
  auto database = Database::open(path);
  if (!database) return tl::unexpected(database.error());
  auto state = std::make_unique<State>(std::move(*database));
  if (auto format = check_format(state->database, schema::recording); !format)
    return tl::unexpected(format.error());
  if (auto whole = check_pages(state->database); !whole) return tl::unexpected(whole.error());
  if (auto header = state->read_header(); !header) return tl::unexpected(header.error());
  if (auto extent = state->read_extent(); !extent) return tl::unexpected(extent.error());
  const auto take = [&](Statement& statement, const std::string& sql) -> Result<void> {
    auto prepared = state->database.prepare(sql);
    if (!prepared) return tl::unexpected(prepared.error());
    statement = std::move(*prepared);
    return {};
  };
  const std::string latest =
      "SELECT data, checksum FROM keyframes WHERE tick <= ?1 ORDER BY tick DESC LIMIT 1";
  if (auto ok = take(state->select_frame, schema::select_from("frames")); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = take(state->select_keyframe, latest); !ok) return tl::unexpected(ok.error());
  if (auto ok = take(state->select_commands, schema::select_from("commands")); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = take(state->select_state, schema::select_from("states")); !ok)
    return tl::unexpected(ok.error());
  std::error_code ignored;
  state->bytes = std::filesystem::file_size(path, ignored);
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
uint64_t RecordingReader::bytes() const {
  return state_->bytes;
}

Result<std::optional<std::vector<uint8_t>>> RecordingReader::state(Tick tick) {
  return state_->database.get(state_->select_state, tick);
}

Result<Tick> RecordingReader::state_before(Tick tick) {
  const auto latest =
      state_->database.number("SELECT max(tick) FROM states WHERE tick <= " + std::to_string(tick));
  if (!latest) return tl::unexpected(latest.error());
  return static_cast<Tick>(latest->value_or(0));
}

Result<RecordedFrame> RecordingReader::frame(Tick tick) {
  CHECK(tick >= state_->first_tick && tick <= state_->last_tick);
  const auto bytes = state_->database.get(state_->select_frame, tick);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!bytes->has_value()) return fail(path() + ": damaged: tick " + std::to_string(tick) + " is missing");
  auto frame = state_->decoded(decode_recorded_frame(**bytes), tick);
  if (frame && frame->tick != tick)
    return fail(path() + ": damaged: the frame of tick " + std::to_string(tick) + " says that it is tick " +
                std::to_string(frame->tick));
  return frame;
}

Result<std::vector<Command>> RecordingReader::commands(Tick tick) {
  CHECK(tick >= state_->first_tick && tick <= state_->last_tick);
  const auto bytes = state_->database.get(state_->select_commands, tick);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!bytes->has_value()) return std::vector<Command>();
  const auto recorded = state_->decoded(decode_recorded_commands(**bytes), tick);
  if (!recorded) return tl::unexpected(recorded.error());
  return from_recorded(*recorded);
}

Result<std::optional<RecordedKeyframe>> RecordingReader::keyframe_before(Tick tick) {
  CHECK(tick <= state_->last_tick);
  const auto bytes = state_->database.get(state_->select_keyframe, tick);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!bytes->has_value()) return std::optional<RecordedKeyframe>();
  auto keyframe = state_->decoded(decode_recorded_keyframe(**bytes), tick);
  if (!keyframe) return tl::unexpected(keyframe.error());
  if (keyframe->tick > tick) return fail(path() + ": damaged: a keyframe of a later tick than it says");
  return std::optional(std::move(*keyframe));
}

}  // namespace scree
