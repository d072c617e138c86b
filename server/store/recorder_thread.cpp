// Recorder's storage thread.
#include <algorithm>
#include <chrono>
#include <fmt/format.h>

#include "server/log/log.h"
#include "server/store/database.h"
#include "server/store/free_space.h"
#include "server/store/limits.h"
#include "server/store/recorder_state.h"
#include "server/store/schema.h"
#include "server/store/store_fault.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

std::chrono::steady_clock::time_point at(double steady_s) {
  using Clock = std::chrono::steady_clock;
  return Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(steady_s)));
}

}  // namespace

/// Ticks wait for the next commit else: waking the thread at every tick would hold ticks up.
bool Recorder::State::must_wake() const {
  const bool has_start = !queue.empty() && queue.front().start != nullptr;
  const bool is_due = queue.size() >= limits::recorder_wake_ticks || wanted > safe;
  return stopping || has_start || (health.ok() && is_due);
}

/// With the mutex.
double Recorder::State::wake_s() const {
  if (next != nullptr) return steady_now_s() + limits::seconds_per_commit;  // the world will wake it
  return health.ok() ? committed_s + limits::seconds_per_commit : pause.next_s();
}

void Recorder::State::run() {
  committed_s = steady_now_s();
  for (;;) {
    bool last = false, fails = false, at_once = false;
    {
      std::unique_lock lock(mutex);
      changed.wait_until(lock, at(wake_s()), [&] { return must_wake(); });
      collect();
      last = stopping;
      fails = !health.ok();
      at_once = wanted > safe;
    }
    if (last) break;
    const double now_s = steady_now_s();
    const bool commits = now_s >= committed_s + limits::seconds_per_commit;
    if (writer == nullptr)
      begin_part();
    else if (!fails || pause.is_over(now_s))
      go_on(commits || at_once || fails);
    if (commits) committed_s = now_s;
  }
  try_last();
  {
    const std::scoped_lock lock(mutex);
    ended = true;
  }
  changed.notify_all();
}

/// With the mutex.
void Recorder::State::collect() {
  for (Entry& entry : queue) waiting.push_back(std::move(entry));
  queue.clear();
  taken = waiting.size();
}

/// Adds what waits. After an error that spoils the file, the recording leaves off there.
void Recorder::State::go_on(bool commits) {
  Result<void> done = write_waiting();
  if (done && commits) done = commit();
  bool is_cut = false, is_over = false;  // ticks are missing behind those that wait; none waits
  {
    const std::scoped_lock lock(mutex);
    is_cut = !accepts;
    is_over = is_cut && waiting.empty() && queue.empty();
  }
  if (done && is_over) {
    if (writer->finish()) note_safe();
    return leave_off();
  }
  if (!done || !is_cut) note(done);
  if (!done && writer->is_spoiled()) leave_off();
}

Result<void> Recorder::State::write_waiting() {
  while (!waiting.empty()) {
    const Entry& entry = waiting.front();
    TRY(writer->add(*entry.delta, entry.commands, entry.noted, entry.part.get(), entry.cursors));
    written = entry.delta->tick;
    const bool was_part = entry.part != nullptr;
    waiting.pop_front();
    const std::scoped_lock lock(mutex);
    taken = waiting.size();
    ++ticks_written;
    if (was_part) part_waits = false;
    wants_part = part_waits ? PartWish::none : writer->wants_part();
  }
  changed.notify_all();
  return {};
}

Result<void> Recorder::State::commit() {
  Stopwatch stopwatch;
  const Result<void> done = writer->commit();
  {
    const std::scoped_lock lock(mutex);
    commits.add(stopwatch.lap_ms());
  }
  TRY(done);
  if (limit.is_on() && writer->has_dropped() && !dropped_older) drop_older_parts();
  note_safe();
  return {};
}

void Recorder::State::note_safe() {
  const uint64_t free_bytes = free_bytes_at(writer->path());
  {
    const std::scoped_lock lock(mutex);
    safe = written;
    size = writer->size();
    size.disk_free_bytes = free_bytes;
  }
  changed.notify_all();
}

/// The ring of this part is whole: it needs none before. Other files may have such a name, too.
void Recorder::State::drop_older_parts() {
  dropped_older = true;
  for (const std::string& part : recording_parts(family)) {
    if (part == writer->path()) return;
    if (!is_foreign(part, schema::recording)) remove_recording(part);
  }
}

void Recorder::State::note(const Result<void>& result) {
  {
    const std::scoped_lock lock(mutex);
    if (result) {
      health.because.reset();
      health.since_unix_ms = 0;
    } else {
      if (health.ok()) health.since_unix_ms = unix_now_ms();
      health.because = result.error().message;
      pause.failed(steady_now_s(), Database::is_held(result.error()));
    }
  }
  changed.notify_all();
}

void Recorder::State::note_hanging() {
  if (!health.ok()) return;
  health.since_unix_ms = unix_now_ms();
  health.because = fmt::format("{}: it has not taken the recording for {:g} s", name_of(StoreFault::hangs),
                               limits::recorder_patience_s);
  changed.notify_all();
}

/// Ticks that wait cannot follow what was committed.
void Recorder::State::leave_off() {
  {
    const std::scoped_lock lock(mutex);
    health.lost += written - std::min(written, safe);
    ticks_written -= std::min(ticks_written, written - std::min(written, safe));
    wants_part = PartWish::none;
    part_waits = false;
  }
  drop_waiting();
  left.add(writer->path());
  writer.reset();
}

void Recorder::State::drop_waiting() {
  {
    const std::scoped_lock lock(mutex);
    for (const auto* entries : {&waiting, &queue})
      health.lost += static_cast<uint64_t>(
          std::ranges::count_if(*entries, [](const Entry& entry) { return entry.start == nullptr; }));
    queue.clear();
    taken = 0;
    accepts = false;
  }
  waiting.clear();
  changed.notify_all();
}

/// Makes a file when one can be made, and then waits for a world.
void Recorder::State::begin_part() {
  if (next != nullptr) {
    if (waiting.empty()) return;
    CHECK(waiting.front().start != nullptr);
    const auto start = waiting.front().start;
    waiting.pop_front();
    return begin_with(*start);
  }
  if (!pause.is_over(steady_now_s())) return;
  auto made = [&]() -> Result<std::unique_ptr<RecordingWriter>> {
    const std::string named = TRY(next_recording_part(family));
    return RecordingWriter::create(named, header, limit);
  }();
  if (!made) return note(tl::unexpected(made.error()));
  next = std::move(*made);
  const std::scoped_lock lock(mutex);
  wants_start = true;
}

void Recorder::State::begin_with(const RecordingStart& start) {
  Result<void> begun = next->begin_with(start);
  if (begun) begun = next->commit();
  if (!begun) {
    const std::string named = next->path();
    next.reset();
    remove_recording(named);
    drop_waiting();
    return note(begun);
  }
  begin_at(std::exchange(next, nullptr), start.keyframe.tick);
  note({});
  left.close();  // the disk works
}

void Recorder::State::begin_at(std::unique_ptr<RecordingWriter> made, Tick tick) {
  writer = std::move(made);
  written = tick;
  dropped_older = false;
  left.forget(writer->path());
  const std::scoped_lock lock(mutex);
  safe = tick;
  path = writer->path();
  begun = true;
}

/// The end of the recording: a copy that is made afterwards has all of it.
void Recorder::State::try_last() {
  write_last();
  if (next != nullptr) {
    const std::string named = next->path();
    next.reset();
    remove_recording(named);
  }
  for (const std::string& line : left.close_all(last_until_s)) log_of(LogPart::store).warn("{}", line);
}

/// A part that waits for its world begins, and a file that is held, or that fails in any other way, may be
/// written soon.
void Recorder::State::write_last() {
  if (next != nullptr && !waiting.empty()) begin_part();
  while (writer != nullptr) {
    Result<void> done = write_waiting();
    if (done) done = commit();
    if (done) done = writer->finish();
    note(done);
    if (done) {
      writer.reset();
      break;
    }
    if (writer->is_spoiled()) return leave_off();
    const double pause_s = std::clamp(pause.next_s() - steady_now_s(), 0.0, limits::retry_held_max_s);
    if (steady_now_s() + pause_s > last_until_s) return leave_off();
    std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
  }
}

}  // namespace scree
