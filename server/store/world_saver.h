// Saves a running world on a storage thread: the simulation hands over what changed, and never waits for the
// disk.
//
// At most one save waits while another is written; while one waits, what changes is gathered for the next
// (skipped saves are counted). Each is one transaction of one tick, and told as saved when it is on the disk.
// No error is the end of saving: another program that holds the file, a full or failing disk and a file that
// was removed are tried again after growing pauses (retry_pause.h), with the file opened anew, or put back.
// The next save that succeeds writes all that is missing. That is bounded: of each changed brick only the
// latest state waits, and none of them leaves memory, so that memory-max refuses edits before there is too
// much. Where the row of a chunk that changed cannot be read, the next save writes the chunk anew, as the
// world has it. The simulation goes on in all cases.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/metrics/durations.h"
#include "server/store/retry_pause.h"
#include "server/store/world_file.h"
#include "server/world/tick_delta.h"

namespace scree {

/// When a world is saved: after each tick in which something happened, once a second, or at the end and every
/// autosave; and whenever limits::unsaved_chunks_max chunks have changed.
enum class Durability : uint8_t { tick, second, off };

struct DurabilityRow {
  std::string_view name;
};

constexpr DurabilityRow row_of(Durability durability) {
  switch (durability) {
    case Durability::tick:
      return {.name = "tick"};
    case Durability::second:
      return {.name = "second"};
    case Durability::off:
      return {.name = "off"};
  }
  return {};
}

struct SaverConfig {
  Durability durability = Durability::second;
  double autosave_s = 300.0;  ///< with Durability::off; 0: only at the end
  uint32_t tick_rate_hz = 60;
  /// Called on the storage thread before a tick is saved; may be empty. A recording of the world must not end
  /// before the world does.
  std::function<void(Tick)> before_save;
  /// How long finish() tries again what fails.
  double last_tries_s = limits::last_tries_s;
};

struct SaverStatus {
  Tick saved_tick = 0;   ///< on the disk
  uint64_t saves = 0;    ///< transactions
  uint64_t skipped = 0;  ///< saves that were due while another one waited
  uint64_t failures = 0;
  uint64_t bytes_written = 0;  ///< in rows
  double save_worst_ms = 0.0;
  double save_last_ms = 0.0;  ///< of the last one, whether it failed or not
  StoreHealth health;
  size_t unsaved_chunks = 0;        ///< that changed, and are in no save yet
  bool save_waits = false;          ///< one, while another is written
  uint64_t disk_free_bytes = 0;     ///< where the file lies, after the last save; 0: nobody knows
  std::vector<ChunkCoord> lacking;  ///< chunks whose rows cannot be read, which the next save needs whole
};

/// The edited bricks of a chunk as the world has them now; empty: it does not have them.
using ChunkNow = std::function<std::vector<BrickState>(ChunkCoord)>;
/// Reads chunks of a world's field, which has the changed bricks until they are saved.
ChunkNow chunk_now(const Field& field);

class WorldSaver {
 public:
  /// `file` holds this world, as of `tick`.
  WorldSaver(std::unique_ptr<WorldFile> file, Tick tick, const TerrainSource& ground, SaverConfig config);
  /// Calls end().
  ~WorldSaver();
  WorldSaver(const WorldSaver&) = delete;
  WorldSaver& operator=(const WorldSaver&) = delete;

  /// Takes what a tick changed; every tick, in order. True: the world is to be saved as of this tick now, by
  /// save(). `pressed`: memory is short until it is saved, so that it is due at once. One thread calls this,
  /// save() and finish().
  bool note(const TickDelta& delta, bool pressed = false);
  /// `now` is asked for chunks that are lacking.
  void save(WorldMoment moment, const ChunkNow& now = {});
  /// Saves the last tick, waits until it is written, merges the file's log, and ends. What fails is tried
  /// again for a while; then the last error is returned, and says which tick the file holds. It is no error
  /// where nothing but the clock has changed since that tick: then status() alone has it.
  Result<void> finish(WorldMoment moment, const ChunkNow& now = {});
  /// Ends without the last tick: writes what was handed over, and joins the thread.
  void end();

  /// From any thread, also after the end.
  SaverStatus status() const;
  /// How long saves took, failed ones too. Likewise.
  Durations times() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
