#include "server/store/recorder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <thread>

#include "server/store/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

struct Recorder::State {
  struct Entry {
    std::shared_ptr<const TickDelta> delta;
    std::vector<Command> commands;
    std::vector<Event> noted;
    std::shared_ptr<const WorldMoment> part;
    std::optional<std::vector<PlayerCursor>> cursors;
  };

  void run();
  void write(const std::deque<Entry>& entries);
  void commit();
  void note(const Result<void>& result);
  /// Else they wait for the next commit: waking the thread at every tick would hold ticks up.
  bool is_due() const { return queue.size() >= limits::recorder_wake_ticks; }

  std::unique_ptr<RecordingWriter> writer;  ///< used by the storage thread only
  Tick written = 0;                         ///< used by the storage thread only, once that runs
  Clock::time_point committed = Clock::now();
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<Entry> queue;
  bool stopping = false;
  std::optional<std::string> error;
  uint64_t ticks_written = 0;
  Tick wanted = 0;     ///< to be committed at once
  Tick safe = 0;       ///< committed
  bool ended = false;  ///< nothing more is written
  uint64_t waits = 0;
  PartWish wants_part = PartWish::none;
  bool part_waits = false;  ///< in the queue
  RecordingSize size;
};

void Recorder::State::note(const Result<void>& result) {
  if (result) return;
  {
    const std::scoped_lock lock(mutex);
    if (!error) error = result.error().message;
  }
  changed.notify_all();
}

void Recorder::State::write(const std::deque<Entry>& entries) {
  for (const Entry& entry : entries) {
    const auto added =
        writer->add(*entry.delta, entry.commands, entry.noted, entry.part.get(), entry.cursors);
    note(added);
    if (!added) return;
    written = entry.delta->tick;
    const std::scoped_lock lock(mutex);
    ++ticks_written;
    if (entry.part) part_waits = false;
    wants_part = part_waits ? PartWish::none : writer->wants_part();
  }
}

void Recorder::State::commit() {
  const Result<void> committed = writer->commit();
  note(committed);
  {
    const std::scoped_lock lock(mutex);
    if (committed) safe = written;
    size = writer->size();
  }
  changed.notify_all();
}

void Recorder::State::run() {
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits::seconds_per_commit));
  for (;;) {
    std::deque<Entry> entries;
    bool last = false;
    bool failed = false;
    bool at_once = false;
    {
      std::unique_lock lock(mutex);
      changed.wait_until(lock, committed + period,
                         [&] { return stopping || is_due() || (wanted > safe && !error); });
      entries.swap(queue);
      last = stopping;
      failed = error.has_value();
      at_once = wanted > safe;
    }
    changed.notify_all();
    if (!failed) {
      write(entries);
      if (last || at_once || Clock::now() >= committed + period) commit();
    }
    if (Clock::now() >= committed + period) committed = Clock::now();
    if (last) break;
  }
  note(writer->finish());
  writer.reset();
  {
    const std::scoped_lock lock(mutex);
    ended = true;
  }
  changed.notify_all();
}

Recorder::Recorder(std::unique_ptr<State> state) : state_(std::move(state)) {}

Recorder::~Recorder() {
  static_cast<void>(finish());
}

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path, const RecordingHeader& header,
                                                   RingLimit limit) {
  auto writer = TRY(RecordingWriter::create(path, header, limit));
  return start(std::move(writer), 0);
}

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path, const RecordingHeader& header,
                                                   const RecordingStart& from, RingLimit limit) {
  std::error_code ignored;
  auto writer = std::filesystem::exists(path, ignored) ? RecordingWriter::resume(path, header, from, limit)
                                                       : RecordingWriter::create(path, header, from, limit);
  TRY(writer);
  return start(std::move(*writer), from.keyframe.tick);
}

std::unique_ptr<Recorder> Recorder::start(std::unique_ptr<RecordingWriter> writer, Tick written) {
  auto state = std::make_unique<State>();
  state->writer = std::move(writer);
  state->written = written;
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<Recorder>(new Recorder(std::move(state)));
}

void Recorder::commit_up_to(Tick tick) {
  std::unique_lock lock(state_->mutex);
  state_->wanted = std::max(state_->wanted, tick);
  state_->changed.notify_all();
  state_->changed.wait(lock, [&] { return state_->safe >= tick || state_->error || state_->ended; });
}

void Recorder::push(std::shared_ptr<const TickDelta> delta, std::vector<Command> commands,
                    std::vector<Event> noted, std::shared_ptr<const WorldMoment> part,
                    std::optional<std::vector<PlayerCursor>> cursors) {
  CHECK(delta != nullptr);
  {
    std::unique_lock lock(state_->mutex);
    const auto room = [&] { return state_->error || state_->queue.size() < limits::recorder_queue_max; };
    if (!room()) ++state_->waits;
    state_->changed.wait(lock, room);
    if (state_->error || state_->stopping) return;
    CHECK(state_->queue.empty() || delta->tick == state_->queue.back().delta->tick + 1);
    if (part) {
      state_->part_waits = true;
      state_->wants_part = PartWish::none;
    }
    state_->queue.push_back(
        {std::move(delta), std::move(commands), std::move(noted), std::move(part), std::move(cursors)});
    CHECK(state_->queue.size() <= limits::recorder_queue_max);
    if (!state_->is_due()) return;
  }
  state_->changed.notify_all();
}

Result<void> Recorder::finish() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
  if (state_->error) return fail(*state_->error);
  return {};
}

std::optional<std::string> Recorder::error() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->error;
}

uint64_t Recorder::ticks_written() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->ticks_written;
}

PartWish Recorder::wants_part() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->wants_part;
}

RecordingSize Recorder::size() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->size;
}

uint64_t Recorder::waits() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->waits;
}

}  // namespace scree
