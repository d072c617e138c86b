#include "server/store/world_keeper.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "server/store/kept_terrain.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Whether clients may hold a reply, or anything else than the clock moved.
bool something_happened(const TickDelta& delta) {
  return !delta.bricks.empty() || !delta.operations.empty() || !delta.pieces.empty() ||
         !delta.replies.empty() || !delta.settings.empty() || delta.work.requests_waiting > 0;
}

/// Ticks between saves that are due whatever happens; 0: none.
Tick period_of(const KeeperConfig& config) {
  const double seconds = config.durability == Durability::off ? config.autosave_s : 1.0;
  if (!(seconds > 0.0)) return 0;
  return std::max<Tick>(1, static_cast<Tick>(seconds * config.tick_rate_hz));
}

}  // namespace

struct WorldKeeper::State {
  /// One save.
  struct Due {
    WorldMoment moment;
    ChangedBricks bricks;
  };

  State(KeeperConfig c, std::unique_ptr<WorldFile> f, const TerrainSource& ground)
      : config(std::move(c)),
        file(std::move(f)),
        terrain(ground, [this](ChunkCoord chunk) { return file->read_chunk(chunk); }) {}
  void run();
  void write(Due due);

  KeeperConfig config;
  Tick period = 0;

  // Of the caller's thread.
  ChangedBricks gathered;
  Tick next_due = 0;  ///< 0: none by the clock
  bool over = false;  ///< nothing is saved any more, nor gathered

  // Of the storage thread.
  std::unique_ptr<WorldFile> file;
  KeptTerrain terrain;  ///< what the next save has to write; reads `file`
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::optional<Due> waiting;
  bool stopping = false;
  KeeperStatus status;
};

void WorldKeeper::State::write(Due due) {
  const Tick tick = due.moment.tick;
  if (config.before_save) config.before_save(tick);
  Stopwatch watch;
  const Result<void> taken = terrain.change(due.bricks);
  const Result<void> saved = taken ? file->save(due.moment, terrain.unsaved(tick)) : taken;
  const double ms = watch.lap_ms();
  if (saved) terrain.saved();
  const std::scoped_lock lock(mutex);
  status.bytes_written = file->bytes_written();
  status.save_worst_ms = std::max(status.save_worst_ms, ms);
  status.error = saved ? std::nullopt : std::optional(saved.error().message);
  if (saved) {
    CHECK(tick >= status.saved_tick);
    status.saved_tick = tick;
    ++status.saves;
    return;
  }
  ++status.failures;
  status.given_up = !taken || !file->is_full();
}

void WorldKeeper::State::run() {
  for (;;) {
    std::optional<Due> due;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return stopping || waiting; });
      due = std::exchange(waiting, std::nullopt);
      if (!due) return;
      if (status.given_up) continue;
    }
    write(std::move(*due));
  }
}

WorldKeeper::WorldKeeper(std::unique_ptr<WorldFile> file, Tick tick, const TerrainSource& ground,
                         KeeperConfig config)
    : state_(std::make_unique<State>(std::move(config), std::move(file), ground)) {
  State& s = *state_;
  s.period = period_of(s.config);
  s.next_due = s.period == 0 ? 0 : tick + s.period;
  s.status.saved_tick = tick;
  s.thread = std::thread([&s] { s.run(); });
}

WorldKeeper::~WorldKeeper() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
}

bool WorldKeeper::note(const TickDelta& delta, bool pressed) {
  State& s = *state_;
  if (s.over) return false;
  for (const BrickState& state : delta.bricks) s.gathered[state.coord] = state;
  const bool by_clock = s.next_due != 0 && delta.tick >= s.next_due;
  if (!by_clock && !pressed && !(s.config.durability == Durability::tick && something_happened(delta)))
    return false;
  const std::scoped_lock lock(s.mutex);
  if (s.status.given_up) {
    s.over = true;
    s.gathered.clear();
    return false;
  }
  if (s.waiting) {
    ++s.status.skipped;  // due again in the next tick
    if (s.next_due != 0) s.next_due = delta.tick + 1;
    return false;
  }
  if (s.next_due != 0) s.next_due = delta.tick + s.period;
  return true;
}

void WorldKeeper::save(WorldMoment moment) {
  State& s = *state_;
  {
    const std::scoped_lock lock(s.mutex);
    CHECK(!s.waiting && !s.stopping);
    s.waiting = State::Due{std::move(moment), std::exchange(s.gathered, {})};
  }
  s.changed.notify_all();
}

Result<void> WorldKeeper::finish(WorldMoment moment) {
  State& s = *state_;
  {
    const std::scoped_lock lock(s.mutex);
    if (s.waiting) {  // nobody needs the older one: its bricks go with the last
      for (auto& [coord, state] : s.gathered) s.waiting->bricks[coord] = std::move(state);
      s.waiting->moment = std::move(moment);
    } else {
      s.waiting = State::Due{std::move(moment), std::exchange(s.gathered, {})};
    }
    s.stopping = true;
  }
  s.changed.notify_all();
  if (s.thread.joinable()) s.thread.join();
  s.file.reset();
  const std::scoped_lock lock(s.mutex);
  if (s.status.error) return fail(*s.status.error);
  return {};
}

KeeperStatus WorldKeeper::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->status;
}

}  // namespace scree
