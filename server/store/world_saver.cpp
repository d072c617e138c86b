#include "server/store/world_saver.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <utility>

#include "server/store/free_space.h"
#include "server/store/limits.h"
#include "server/store/store_fault.h"
#include "server/store/unsaved_terrain.h"
#include "server/world/shared_brick.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

/// Whether clients may hold a reply, or anything else than the clock moved.
bool something_happened(const TickDelta& delta) {
  return !delta.bricks.empty() || !delta.operations.empty() || !delta.pieces.empty() ||
         !delta.replies.empty() || !delta.settings.empty() || delta.work.requests_waiting > 0;
}

/// Why a save waits for chunks.
std::string reason_of(const std::map<ChunkCoord, std::string>& lacking) {
  const auto& [chunk, reason] = *lacking.begin();
  return fmt::format("chunk {}, {}, {}{} must be written anew: {}", chunk.x, chunk.y, chunk.z,
                     (lacking.size() == 1 ? "" : fmt::format(" and {} more", lacking.size() - 1)), reason);
}

/// Ticks between saves that are due whatever happens; 0: none.
Tick period_of(const SaverConfig& config) {
  const double seconds = config.durability == Durability::off ? config.autosave_s : 1.0;
  if (!(seconds > 0.0)) return 0;
  return std::max<Tick>(1, static_cast<Tick>(seconds * config.tick_rate_hz));
}

}  // namespace

ChunkNow chunk_now(const Field& field) {
  return [&field](ChunkCoord chunk) {
    std::vector<BrickState> bricks;
    if (field.is_out(chunk)) return bricks;
    for (const BrickCoord coord : field.edited_bricks(chunk)) {
      const Brick& brick = field.brick(coord);
      const BrickMaterials materials = field.materials(coord);
      bricks.push_back({coord, shared_copy(brick), brick_hash(coord, brick, materials), materials});
    }
    return bricks;
  };
}

struct WorldSaver::State {
  /// One save.
  struct Due {
    WorldMoment moment;
    ChangedBricks bricks;
    std::map<ChunkCoord, std::vector<BrickState>> whole;  ///< chunks that were lacking
  };

  State(SaverConfig c, std::unique_ptr<WorldFile> f, const TerrainSource& ground)
      : config(std::move(c)),
        file(std::move(f)),
        terrain(ground, [this](ChunkCoord chunk) { return file->read_chunk(chunk); }) {}
  void run();
  void write(Due due);
  Result<void> open_anew();
  void note(Tick tick, double ms, const Result<void>& saved);
  void try_last(const WorldMoment& moment, const ChunkNow& now, double until_s);
  std::map<ChunkCoord, std::vector<BrickState>> whole_chunks(const ChunkNow& now) const;
  bool has_nothing_to_lose() const;

  SaverConfig config;
  Tick period = 0;

  // Members of the caller's thread.
  Tick changed_tick = 0;  ///< the last in which anything but the clock changed
  ChangedBricks gathered;
  std::unordered_set<ChunkCoord, CoordHash> gathered_chunks;  ///< of those bricks
  Tick next_due = 0;                                          ///< 0: none by the clock

  // Members of the storage thread.
  std::unique_ptr<WorldFile> file;
  UnsavedTerrain terrain;  ///< what the next save has to write; reads `file`
  bool is_shaken = false;  ///< the last save failed: the file is opened anew
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::optional<Due> waiting;
  bool stopping = false;
  RetryPause pause;
  SaverStatus status;
  Durations times;
};

/// A connection may hold what is not so any more once its file failed.
Result<void> WorldSaver::State::open_anew() {
  if (!is_shaken) return {};
  auto anew = TRY(file->opened_anew());
  file = std::move(anew);
  return {};
}

void WorldSaver::State::write(Due due) {
  const Tick tick = due.moment.tick;
  if (config.before_save) config.before_save(tick);
  Stopwatch stopwatch;
  Result<void> saved = open_anew();
  terrain.change(due.bricks);
  for (const auto& [chunk, bricks] : due.whole) terrain.replace_chunk(chunk, bricks);
  if (saved && !terrain.lacking().empty()) saved = fail(reason_of(terrain.lacking()));
  if (saved) saved = file->save(due.moment, terrain.unsaved(tick));
  if (saved) terrain.saved();
  is_shaken = !saved;
  note(tick, stopwatch.lap_ms(), saved);
}

void WorldSaver::State::note(Tick tick, double ms, const Result<void>& saved) {
  const uint64_t free_bytes = free_bytes_at(file->path());  // asks the disk
  const std::scoped_lock lock(mutex);
  status.bytes_written = file->bytes_written();
  status.save_worst_ms = std::max(status.save_worst_ms, ms);
  status.disk_free_bytes = free_bytes;
  times.add(ms);
  status.save_last_ms = ms;
  status.lacking.clear();
  for (const auto& [chunk, reason] : terrain.lacking()) status.lacking.push_back(chunk);
  if (saved) {
    CHECK(tick >= status.saved_tick);
    status.health = {};
    status.saved_tick = tick;
    ++status.saves;
    return;
  }
  ++status.failures;
  if (status.health.ok()) status.health.since_unix_ms = unix_now_ms();
  status.health.because = saved.error().message;
  // A chunk that is lacking comes with the next save, which need not wait.
  if (status.lacking.empty()) pause.failed(steady_now_s(), is_held(saved.error()));
}

void WorldSaver::State::run() {
  for (;;) {
    std::optional<Due> due;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return stopping || waiting; });
      due = std::exchange(waiting, std::nullopt);
      if (!due) return;
    }
    write(std::move(*due));
  }
}

WorldSaver::WorldSaver(std::unique_ptr<WorldFile> file, Tick tick, const TerrainSource& ground,
                       SaverConfig config)
    : state_(std::make_unique<State>(std::move(config), std::move(file), ground)) {
  State& s = *state_;
  s.period = period_of(s.config);
  s.next_due = s.period == 0 ? 0 : tick + s.period;
  s.status.saved_tick = s.changed_tick = tick;
  s.thread = std::thread([&s] { s.run(); });
}

WorldSaver::~WorldSaver() {
  end();
}

void WorldSaver::end() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
}

bool WorldSaver::note(const TickDelta& delta, bool pressed) {
  State& s = *state_;
  if (something_happened(delta)) s.changed_tick = delta.tick;
  for (const BrickState& state : delta.bricks) {
    s.gathered[state.coord] = state;
    s.gathered_chunks.insert(chunk_of(state.coord));
  }
  const std::scoped_lock lock(s.mutex);
  s.status.unsaved_chunks = s.gathered_chunks.size();
  const bool fails = !s.status.health.ok();
  // While it fails, the pauses alone say when.
  if (fails && !s.pause.is_over(steady_now_s())) return false;
  const bool by_clock = s.next_due != 0 && delta.tick >= s.next_due;
  const bool much = s.gathered_chunks.size() >= limits::unsaved_chunks_max;
  if (!by_clock && !pressed && !much && !fails &&
      !(s.config.durability == Durability::tick && something_happened(delta)))
    return false;
  if (s.waiting) {
    ++s.status.skipped;  // due again in the next tick
    if (s.next_due != 0) s.next_due = delta.tick + 1;
    return false;
  }
  if (s.next_due != 0) s.next_due = delta.tick + s.period;
  return true;
}

/// Those that are lacking, as far as the world has them.
std::map<ChunkCoord, std::vector<BrickState>> WorldSaver::State::whole_chunks(const ChunkNow& now) const {
  std::map<ChunkCoord, std::vector<BrickState>> whole;
  if (!now) return whole;
  for (const ChunkCoord chunk : status.lacking)
    if (std::vector<BrickState> bricks = now(chunk); !bricks.empty()) whole[chunk] = std::move(bricks);
  return whole;
}

void WorldSaver::save(WorldMoment moment, const ChunkNow& now) {
  State& s = *state_;
  {
    const std::scoped_lock lock(s.mutex);
    CHECK(!s.waiting && !s.stopping);
    s.waiting = State::Due{std::move(moment), std::exchange(s.gathered, {}), s.whole_chunks(now)};
    s.gathered_chunks.clear();
  }
  s.changed.notify_all();
}

Result<void> WorldSaver::finish(WorldMoment moment, const ChunkNow& now) {
  State& s = *state_;
  const double until_s = steady_now_s() + s.config.last_tries_s;  // what is being written counts
  {
    const std::scoped_lock lock(s.mutex);
    if (!s.waiting) s.waiting = State::Due{};
    // Nobody needs an older one: its bricks go with the last.
    for (auto& [coord, state] : s.gathered) s.waiting->bricks[coord] = std::move(state);
    s.waiting->moment = moment;
    for (auto& [chunk, bricks] : s.whole_chunks(now)) s.waiting->whole[chunk] = std::move(bricks);
    s.stopping = true;
  }
  s.changed.notify_all();
  if (s.thread.joinable()) s.thread.join();
  if (!s.has_nothing_to_lose()) s.try_last(moment, now, until_s);
  const bool has_all = s.status.health.ok() || s.has_nothing_to_lose();
  // Where that fails, the log that is left has the rows.
  if (s.status.health.ok()) static_cast<void>(s.file->merge_log());
  s.file.reset();
  if (has_all) return {};
  return fail(fmt::format(
      "the world's last ticks are not saved: its file holds tick {}, and the world stood at {}: {}",
      s.status.saved_tick, moment.tick, *s.status.health.because));
}

/// Once the thread has ended: whether a file that cannot be written has all but the clock. Nobody knows the
/// content of a failing disk.
bool WorldSaver::State::has_nothing_to_lose() const {
  if (status.health.ok() || !status.lacking.empty() || changed_tick > status.saved_tick) return false;
  if (file->has_moved()) return false;
  const auto fault = fault_in(*status.health.because);
  return fault &&
         (*fault == StoreFault::held || *fault == StoreFault::read_only || row_of(*fault).is_refusal);
}

/// Once the thread has ended: chunks that are lacking, and what fails, until the time for that is over.
void WorldSaver::State::try_last(const WorldMoment& moment, const ChunkNow& now, double until_s) {
  bool was_whole = false;
  while (!status.health.ok()) {
    auto whole = whole_chunks(now);
    if (whole.empty() || std::exchange(was_whole, true)) {
      const double pause_s = std::clamp(pause.next_s() - steady_now_s(), 0.0, limits::retry_held_max_s);
      if (steady_now_s() + pause_s > until_s) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
    }
    write({moment, {}, std::move(whole)});
  }
}

SaverStatus WorldSaver::status() const {
  const std::scoped_lock lock(state_->mutex);
  SaverStatus status = state_->status;
  status.save_waits = state_->waiting.has_value();
  return status;
}

Durations WorldSaver::times() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->times;
}

}  // namespace scree
