// What a Recorder is made of. Internal to its own sources: recorder.cpp has its calls, recorder_thread.cpp
// its storage thread, recorder_open.cpp its beginning.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "server/store/left_parts.h"
#include "server/store/recorder.h"
#include "server/store/recording_writer.h"
#include "server/store/retry_pause.h"

namespace scree {

struct Recorder::State {
  struct Entry {
    std::shared_ptr<const TickDelta> delta;
    std::vector<Command> commands;
    std::vector<Event> noted;
    std::shared_ptr<const WorldMoment> part;
    std::optional<std::vector<PlayerCursor>> cursors;
    std::shared_ptr<const RecordingStart> start{};  ///< another part begins so, instead of a tick
  };

  State(std::string named, RecordingHeader h, RingLimit l)
      : family(std::move(named)), header(std::move(h)), limit(l), left(family), path(family) {}

  void run();
  void collect();
  void go_on(bool commits);
  Result<void> write_waiting();
  Result<void> commit();
  void note_safe();
  double wake_s() const;
  void drop_older_parts();
  void note(const Result<void>& result);
  /// With the mutex: the disk neither takes what waits nor refuses it. The next write that succeeds is well.
  void note_hanging();
  void leave_off();
  void begin_part();
  void begin_with(const RecordingStart& start);
  void drop_waiting();
  void try_last();
  void write_last();
  void begin_at(std::unique_ptr<RecordingWriter> made, Tick tick);
  void fails_from_the_start(const Error& why);

  // Members of the storage thread, once that runs.
  const std::string family;  ///< the path that was asked for
  const RecordingHeader header;
  const RingLimit limit;
  std::unique_ptr<RecordingWriter> writer;  ///< null: another part is to begin
  std::unique_ptr<RecordingWriter> next;    ///< made, and waits for a world to begin with
  std::deque<Entry> waiting;                ///< taken from the queue, and not written
  Tick written = 0;
  double committed_s = 0.0;
  RetryPause pause;
  LeftParts left;
  bool dropped_older = false;  ///< parts before this one, which the ring does not need any more
  std::thread thread;

  /// With `mutex`: whether the storage thread has something to do now.
  bool must_wake() const;
  size_t entries() const { return queue.size() + taken; }

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<Entry> queue;
  size_t taken = 0;     ///< size of `waiting`
  bool accepts = true;  ///< ticks; false: none can follow what was written
  bool wants_start = false;
  bool stopping = false;
  double last_until_s = 0.0;  ///< once it stops: when trying again ends, by steady_now_s()
  StoreHealth health;
  std::string path;    ///< of the last part
  bool begun = false;  ///< any part, since the start
  uint64_t ticks_written = 0;
  Tick wanted = 0;     ///< to be committed at once
  Tick safe = 0;       ///< committed
  bool ended = false;  ///< nothing more is written
  uint64_t waits = 0;
  PartWish wants_part = PartWish::none;
  bool part_waits = false;  ///< in the queue
  RecordingSize size;
  Durations commits;
};

}  // namespace scree
