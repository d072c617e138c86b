#include "server/store/recording_writer.h"

#include "server/store/database.h"
#include "server/store/limits.h"
#include "server/store/schema.h"
#include "shared/base/check.h"
#include "shared/base/thread_check.h"

namespace scree {

struct RecordingWriter::State {
  explicit State(Database d) : database(std::move(d)) {}
  Result<void> begin();
  Result<void> prepare(const RecordingHeader& header);

  Database database;
  Statement insert_frame;
  Statement insert_keyframe;
  Statement insert_commands;
  PublishedState published;  ///< after the last tick that was added
  bool in_transaction = false;
  ThreadCheck storage_thread;
};

Result<void> RecordingWriter::State::begin() {
  if (in_transaction) return {};
  auto begun = database.execute("BEGIN IMMEDIATE");
  in_transaction = begun.has_value();
  return begun;
}

Result<void> RecordingWriter::State::prepare(const RecordingHeader& header) {
  const std::string settings =
      "PRAGMA page_size = 16384; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
      "PRAGMA wal_autocheckpoint = " +
      std::to_string(limits::wal_pages_max) + ";";
  if (auto done = database.execute(settings); !done) return done;
  if (auto done = database.execute("BEGIN;" + schema::create_tables()); !done) return done;
  auto insert_header = database.prepare(schema::insert_into("header"));
  if (!insert_header) return tl::unexpected(insert_header.error());
  const std::vector<uint8_t> bytes = encode(to_recorded(header));
  if (auto done = database.put(*insert_header, 0, bytes); !done) return done;
  if (auto done = database.execute("COMMIT"); !done) return done;
  const auto take = [this](Statement& statement, const char* table) -> Result<void> {
    auto prepared = database.prepare(schema::insert_into(table));
    if (!prepared) return tl::unexpected(prepared.error());
    statement = std::move(*prepared);
    return {};
  };
  if (auto done = take(insert_frame, "frames"); !done) return done;
  if (auto done = take(insert_keyframe, "keyframes"); !done) return done;
  return take(insert_commands, "commands");
}

RecordingWriter::RecordingWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

RecordingWriter::~RecordingWriter() {
  static_cast<void>(commit());
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 const RecordingHeader& header) {
  auto database = Database::create(path);
  if (!database) return tl::unexpected(database.error());
  auto state = std::make_unique<State>(std::move(*database));
  if (auto prepared = state->prepare(header); !prepared) return tl::unexpected(prepared.error());
  return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(state)));
}

Result<void> RecordingWriter::add(const TickDelta& delta, std::span<const Command> commands) {
  State& state = *state_;
  CHECK(state.storage_thread.is_the_same());
  if (auto begun = state.begin(); !begun) return begun;
  const std::vector<uint8_t> frame = encode(to_recorded(delta, state.published));
  CHECK_DEBUG(decode_recorded_frame(frame).has_value());
  if (auto put = state.database.put(state.insert_frame, delta.tick, frame); !put) return put;
  if (!commands.empty()) {
    const std::vector<uint8_t> recorded = encode(to_recorded(commands));
    if (auto put = state.database.put(state.insert_commands, delta.tick, recorded); !put) return put;
  }
  state.published.apply(delta);
  if (delta.tick % limits::ticks_per_keyframe != 0) return {};
  const std::vector<uint8_t> keyframe = encode(to_recorded_keyframe(state.published.as_delta()));
  // A keyframe too large for a row is left out: seeking starts from an earlier one.
  if (keyframe.size() > limits::row_bytes_max) return {};
  CHECK_DEBUG(decode_recorded_keyframe(keyframe).has_value());
  return state.database.put(state.insert_keyframe, delta.tick, keyframe);
}

Result<void> RecordingWriter::commit() {
  if (!state_->in_transaction) return {};
  state_->in_transaction = false;
  return state_->database.execute("COMMIT");
}

Result<void> RecordingWriter::finish() {
  if (auto committed = commit(); !committed) return committed;
  CHECK(!state_->in_transaction);
  return state_->database.execute("PRAGMA journal_mode = DELETE");
}

}  // namespace scree
