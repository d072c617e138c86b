#include "server/store/recording_reader.h"

#include <filesystem>
#include <fstream>

#include "server/store/database.h"
#include "server/store/schema.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::string_view sqlite_magic("SQLite format 3\0", 16);

/// SQLite reads the missing end of a last page as zeros. After a crash, the log beside the file has that end.
Result<void> check_whole_pages(const std::string& path, const std::string& start) {
  CHECK(start.size() >= sqlite_magic.size() + 2);
  const auto byte = [&](size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(start[at])); };
  const unsigned stored = (byte(16) << 8U) | byte(17);  // SQLite file format, 1.3.2
  const unsigned page_bytes = stored == 1 ? 65536 : stored;
  std::error_code error;
  const uint64_t bytes = std::filesystem::file_size(path, error);
  if (page_bytes != 0 && bytes % page_bytes == 0) return {};
  if (std::filesystem::exists(path + "-wal", error)) return {};
  return fail(path + ": damaged or cut short: " + std::to_string(bytes) + " bytes are no whole pages");
}

/// Refuses a file that is no SQLite file before SQLite opens it.
Result<void> check_magic(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fail(path + ": there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) return fail(path + " is not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(path + " cannot be read: check its permissions");
  std::string start(sqlite_magic.size() + 2, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (static_cast<size_t>(file.gcount()) < start.size())
    return fail(path + " is no recording: it has only " + std::to_string(file.gcount()) + " bytes");
  if (!start.starts_with(sqlite_magic)) return fail(path + " is no recording: it is not an SQLite file");
  return check_whole_pages(path, start);
}

}  // namespace

struct RecordingReader::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> check_format();
  Result<void> read_header();
  Result<void> read_extent();
  template <typename T>
  Result<T> decoded(Result<T> result, Tick tick) const;

  Database database;
  RecordingHeader header;
  Tick last_tick = 0;
  uint64_t keyframes = 0;
  uint64_t bytes = 0;
  Statement select_frame;
  Statement select_keyframe;
  Statement select_commands;
};

Result<void> RecordingReader::State::check_format() {
  const auto id = database.number("PRAGMA application_id");
  if (!id) return tl::unexpected(id.error());
  if (id->value_or(0) != schema::application_id)
    return fail(database.path() + " is no recording: it is an SQLite file of another program");
  const auto format = database.number("PRAGMA user_version");
  if (!format) return tl::unexpected(format.error());
  if (format->value_or(0) != recording_format)
    return fail(database.path() + " is a recording of format " + std::to_string(format->value_or(0)) +
                "; this program reads format " + std::to_string(recording_format) +
                ": play it with the release that recorded it");
  const auto check = database.text("PRAGMA quick_check(1)");
  if (!check) return tl::unexpected(check.error());
  if (*check != "ok") return fail(database.path() + ": damaged or cut short: " + *check);
  return {};
}

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
  if (*first != 1 || *last != *count)
    return fail(database.path() + ": damaged: ticks are missing (" + std::to_string(**count) + " from " +
                std::to_string(**first) + " to " + std::to_string(**last) + ")");
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
  if (auto magic = check_magic(path); !magic) return tl::unexpected(magic.error());
  auto database = Database::open(path);
  if (!database) return tl::unexpected(database.error());
  auto state = std::make_unique<State>(std::move(*database));
  if (auto format = state->check_format(); !format) return tl::unexpected(format.error());
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
Tick RecordingReader::last_tick() const {
  return state_->last_tick;
}
uint64_t RecordingReader::keyframes() const {
  return state_->keyframes;
}
uint64_t RecordingReader::bytes() const {
  return state_->bytes;
}

Result<RecordedFrame> RecordingReader::frame(Tick tick) {
  CHECK(tick >= 1 && tick <= state_->last_tick);
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
  CHECK(tick >= 1 && tick <= state_->last_tick);
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
