#include "server/app/live_server.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <spdlog/spdlog.h>
#include <thread>

#include "server/app/admission.h"
#include "server/app/ground_giver.h"
#include "server/app/live_events.h"
#include "server/app/saved_world.h"
#include "server/app/terrain_ahead.h"
#include "server/app/tick_schedule.h"
#include "server/app/tick_trace.h"
#include "server/store/recorder.h"
#include "server/world/settings.h"
#include "server/world/world_snapshot.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

/// Period at which a server that waits for its first clients counts them.
constexpr std::chrono::milliseconds wait_period{5};

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

}  // namespace

struct LiveServer::State {
  explicit State(const LiveConfig& c) : config(c) {}

  Result<void> open();
  Result<void> open_world();
  Result<void> open_recorder();
  Result<void> open_events();
  Saving saving() const;
  void tell();
  std::shared_ptr<const TickDelta> keep(std::shared_ptr<const TickDelta> delta, std::vector<Reply> refused);
  Result<void> start_keeping();
  void run();
  bool step();
  bool wait_for_clients();
  bool time_is_over() const {
    return config.seconds_max > 0.0 && Clock::now() >= started + seconds(config.seconds_max);
  }
  void record(std::shared_ptr<const TickDelta> delta, std::vector<Command> carried_out,
              std::vector<Event> noted);
  /// Notes nothing where nobody wants to know.
  bool has_events() const { return !config.events_path.empty() || !config.record_path.empty(); }
  void count(TickSchedule::Delay delay);
  bool sleep_until(Clock::time_point when);
  void end(const std::string& error);

  LiveConfig config;
  CommandQueue commands;
  std::unique_ptr<TickFeed> feed;      ///< used by the simulation thread only, but for control()
  std::unique_ptr<LiveEvents> events;  ///< null: nobody wants to know
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<SavedWorld> kept;     ///< null: a replay
  std::unique_ptr<TerrainPager> pager;  ///< likewise
  Admission admission;
  std::unique_ptr<NetServer> net;
  std::unique_ptr<TerrainAhead> ahead;  ///< null: a recording's ticks need no terrain
  std::unique_ptr<Trace> trace;         ///< null: no trace
  std::thread thread;
  Clock::time_point started = Clock::now();
  Clock::duration period{};
  bool record_failed = false;  ///< used by the simulation thread only
  bool saved = false;          ///< for good; used by the owner's thread only

  const std::shared_ptr<ChunkFetcher> for_clients = std::make_shared<ChunkFetcher>();
  uint64_t read_before = 0;  ///< chunks, until the last second began; used by the simulation thread only
  uint32_t read_last_second = 0;
  bool broken = false;  ///< the world does not stand between two ticks; used as saved is

  mutable std::mutex mutex;  ///< guards the members below
  Saving told;
  std::condition_variable changed;
  bool stopping = false;
  bool running = true;
  ServerReport report;
  std::shared_ptr<const TickDelta> last_delta;
};

Result<void> LiveServer::State::open() {
  config.net.service = config.world.service;  // those of a recording are not this server's
  const Digest given = config.world.ground;
  const bool keeps = !config.record_path.empty() || !config.world_path.empty();
  CHECK(!keeps || config.world.terrain.heights == nullptr || given != Digest{});
  if (!config.replay.path.empty()) {
    if (!config.record_path.empty())
      return fail("a replay is not recorded again: copy " + config.replay.path + " instead (--record)");
    if (!config.world_path.empty()) return fail("a replay has no world to keep (--world)");
    if (!config.events_path.empty())
      return fail("a replay's events are its recording's: scree replay export (--events)");
    auto replay = replay_feed(config.replay, ground_giver(config.replay.path, config.world),
                              config.net.ticks_per_transform);
    if (!replay) return tl::unexpected(replay.error());
    feed = std::move(replay->feed);
    config.world = replay->world;
    config.net.replay = true;
    config.net.control = [this](const ControlReplay& wish) { return feed->control(wish); };
  } else if (auto opened = open_world(); !opened) {
    return opened;
  }
  if (config.world.ground != given && given != Digest{})
    return fail(config.world_path + config.replay.path + ": its terrain is generated, not the ground " +
                hex_of(given) + " (--ground)");
  config.net.terrain = config.world.terrain;
  config.net.tick_rate_hz = config.world.tick_rate_hz;
  period = seconds(1.0 / static_cast<double>(config.world.tick_rate_hz));
  if (auto opened = open_events(); !opened) return opened;
  // The port comes first: a server that cannot listen leaves no empty recording behind.
  auto listening = NetServer::listen(config.net, commands);
  if (!listening) return tl::unexpected(listening.error());
  net = std::move(*listening);
  if (auto opened = open_recorder(); !opened) return opened;
  if (kept != nullptr)
    if (auto started = start_keeping(); !started) return started;
  if (World* world = feed->world(); world != nullptr && world->tick() > 0) {
    const auto keyframe = std::make_shared<const TickDelta>(world->keyframe());
    report.settings = keyframe->settings;  // ticks say only what changes
    net->publish(keyframe);
  }
  if (feed->world() != nullptr) ahead = std::make_unique<TerrainAhead>(config.world.terrain);
  if (!config.trace_path.empty()) trace = std::make_unique<Trace>();
  return {};
}

Result<void> LiveServer::State::open_world() {
  const std::string& path = config.world_path;
  auto opened = path.empty() ? SavedWorld::open_temporary(config.world, config.sim_threads)
                             : SavedWorld::open(path, config.world, config.sim_threads,
                                                ground_giver(path, config.world), config.bricks_in_max);
  if (!opened) return tl::unexpected(opened.error());
  kept = std::move(*opened);
  feed = feed_of(kept->take_world());
  config.world = feed->world()->config();
  config.net.service = config.world.service;
  config.net.world = kept->number();
  config.net.first_session = kept->first_session();
  config.net.chunks = for_clients;
  config.net.saving = [this] { return saving(); };
  report.world_path = path;
  return {};
}

/// What clients are told; on the network thread.
Saving LiveServer::State::saving() const {
  const std::scoped_lock lock(mutex);
  return told;
}

/// The file of a new world is made here.
Result<void> LiveServer::State::start_keeping() {
  KeeperConfig keeping{config.durability, config.autosave_s, config.world.tick_rate_hz, {}};
  if (kept->is_temporary()) keeping.durability = Durability::off, keeping.autosave_s = 0.0;
  if (recorder) keeping.before_save = [this](Tick tick) { recorder->commit_up_to(tick); };
  World& world = *feed->world();
  if (auto started = kept->start(world, std::move(keeping)); !started) return started;
  auto opened = TerrainPager::open(kept->path(), world.field(), for_clients, config.bricks_in_max);
  if (!opened) return tl::unexpected(opened.error());
  pager = std::move(*opened);
  tell();
  return {};
}

/// Once a tick: how the world is kept, and where its terrain is.
void LiveServer::State::tell() {
  const KeeperStatus status = kept->status();
  const PagerStatus paged = pager->status();
  Saving now;
  now.how = status.given_up ? "failed" : std::string(row_of(config.durability).name);
  now.tick = status.saved_tick;
  if (kept->is_temporary()) now = {};
  if (feed->world()->tick() % config.world.tick_rate_hz == 0)
    read_last_second =
        static_cast<uint32_t>(paged.chunks_read - std::exchange(read_before, paged.chunks_read));
  now.paging = {paged.chunks_in, paged.chunks_out, read_last_second, paged.waits, admission.held()};
  const std::scoped_lock lock(mutex);
  told = std::move(now);
}

Result<void> LiveServer::State::open_recorder() {
  if (config.record_path.empty()) return {};
  const RecordingHeader header{"scree-server " SCREE_VERSION, config.world};
  World& world = *feed->world();
  std::error_code ignored;  // a kept world may stand at tick 0 again: ended at once, or rolled back
  const bool goes_on =
      world.tick() > 0 || (kept && !kept->is_new() && std::filesystem::exists(config.record_path, ignored));
  if (world.field().pages() && world.field().chunks_out() > 0)
    return fail(config.record_path +
                ": a recording begins with all of the world's terrain, which is more than "
                "half of the memory takes: raise memory-max, or do not record (--record)");
  auto recording = goes_on
                       ? Recorder::create(config.record_path, header, {world.snapshot(), world.keyframe()})
                       : Recorder::create(config.record_path, header);
  if (!recording) return tl::unexpected(recording.error());
  recorder = std::move(*recording);
  report.record_path = config.record_path;
  return {};
}

Result<void> LiveServer::State::open_events() {
  if (!has_events()) return {};
  auto opened = LiveEvents::open(config.events_path, config.world, print(config.world));
  if (!opened) return tl::unexpected(opened.error());
  events = std::move(*opened);
  config.net.noted = [this](Event event) { events->note(std::move(event)); };
  if (const World* world = feed->world(); world->tick() > 0)
    events->note({.kind = EventKind::rebuild, .text = config.world_path});
  report.events_path = config.events_path;
  return {};
}

void LiveServer::State::end(const std::string& error) {
  const std::scoped_lock lock(mutex);
  running = false;
  if (error.empty()) return;
  spdlog::error("{}", error);
  if (!report.error) report.error = error;
}

/// When the recording cannot be written, it ends, and the server goes on.
void LiveServer::State::record(std::shared_ptr<const TickDelta> delta, std::vector<Command> carried_out,
                               std::vector<Event> noted) {
  recorder->push(std::move(delta), std::move(carried_out), std::move(noted));
  if (record_failed) return;
  const auto error = recorder->error();
  if (!error) return;
  record_failed = true;
  spdlog::error("the recording ends after {} ticks: {}", recorder->ticks_written(), *error);
}

/// Runs one tick. False when it was the last.
bool LiveServer::State::step() {
  const Clock::time_point begin = Clock::now();
  Admitted admitted{commands.drain(), {}};
  if (World* world = feed->world()) {
    world->watch(net->is_watched());
    ahead->serve(world->field(), net->eyes_m());
    pager->begin_tick();
    admitted = admission.admit(std::move(admitted.commands), *pager, *world, !kept->status().error);
  }
  TickSpan ran{steady_now_s(), 0.0};
  const auto next = feed->next(admitted.commands);
  ran.done_s = steady_now_s();
  if (!next) {
    broken = true;
    end(next.error().message);
    return false;
  }
  std::shared_ptr<const TickDelta> delta = *next;
  if (!delta) {
    spdlog::info("the recording ends here");
    end("");
    return false;
  }
  if (trace) trace_tick(*trace, begin, *delta);
  std::vector<Event> noted = events ? events->take(*delta) : std::vector<Event>();
  if (recorder) record(delta, std::move(admitted.commands), std::move(noted));
  if (kept) delta = keep(std::move(delta), std::move(admitted.refused));
  const Clock::time_point handing_over = Clock::now();
  {
    const TraceSpan span(trace.get(), "simulation", "hand over");
    net->publish(delta, ran);
  }
  const std::scoped_lock lock(mutex);
  report.whole_tick.add(std::chrono::duration<double, std::milli>(handing_over - begin).count());
  report.add(*delta);
  last_delta = delta;
  if (config.ticks_max != 0 && report.ticks >= config.ticks_max) running = false;
  if (time_is_over()) running = false;
  return running;
}

/// Saves the tick when it is due, and lets terrain go that nobody needs. Returns what clients are told: the
/// recording has no requests that never reached the simulation.
std::shared_ptr<const TickDelta> LiveServer::State::keep(std::shared_ptr<const TickDelta> delta,
                                                         std::vector<Reply> refused) {
  World& world = *feed->world();
  admission.answered(delta->replies);
  kept->keep(*delta, world, pager->pressed());
  pager->end_tick(*delta, kept->status().saved_tick, net->eyes_m(), world.config().memory_max_mb);
  tell();
  if (refused.empty()) return delta;
  auto told_delta = std::make_shared<TickDelta>(*delta);
  told_delta->replies.insert(told_delta->replies.end(), refused.begin(), refused.end());
  return told_delta;
}

/// False when the server is to stop.
bool LiveServer::State::sleep_until(Clock::time_point when) {
  std::unique_lock lock(mutex);
  changed.wait_until(lock, when, [this] { return stopping; });
  return !stopping;
}

bool LiveServer::State::wait_for_clients() {
  while (net->stats().sessions_joined < config.wait_clients)
    if (!sleep_until(Clock::now() + wait_period) || time_is_over()) return false;
  return true;
}

void LiveServer::State::count(TickSchedule::Delay delay) {
  if (!delay.late) return;
  const std::scoped_lock lock(mutex);
  ++report.late_ticks;
  if (delay.lost_ticks == 0) return;
  report.overruns += delay.lost_ticks;
  // A replay may take its time for a jump.
  spdlog::log(config.replay.path.empty() ? spdlog::level::warn : spdlog::level::debug,
              "tick {} came {} ticks late: they are lost", report.last_tick, delay.lost_ticks);
}

void LiveServer::State::run() {
  if (!wait_for_clients()) return end("");
  TickSchedule schedule(Clock::now(), period);
  while (sleep_until(schedule.due()) && step()) count(schedule.tick_ended(Clock::now()));
  end("");
}

LiveServer::LiveServer(std::unique_ptr<State> state) : state_(std::move(state)) {}

LiveServer::~LiveServer() {
  static_cast<void>(stop());
}

Result<std::unique_ptr<LiveServer>> LiveServer::start(const LiveConfig& config) {
  auto state = std::make_unique<State>(config);
  if (auto opened = state->open(); !opened) return tl::unexpected(opened.error());
  if (config.pacing == Pacing::real_time) state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<LiveServer>(new LiveServer(std::move(state)));
}

uint16_t LiveServer::port() const {
  return state_->net->port();
}

bool LiveServer::step_once() {
  if (!running()) return false;
  const bool more = state_->step();
  state_->net->flush();
  return more;
}

bool LiveServer::running() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->running;
}

Result<void> LiveServer::reload() {
  return state_->net->reload();
}

Result<void> LiveServer::stop() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
  state_->end("");
  state_->net->stop();
  if (state_->kept && !state_->saved) {
    state_->saved = true;
    if (state_->broken)
      state_->kept->abandon();
    else if (const auto finished = state_->kept->finish(*state_->feed->world()); !finished)
      state_->end(finished.error().message);
  }
  if (state_->recorder)
    if (const auto finished = state_->recorder->finish(); !finished) state_->end(finished.error().message);
  if (state_->trace)
    if (const auto written = state_->trace->write(state_->config.trace_path); !written)
      state_->end(written.error().message);
  const ServerReport all = report();
  if (all.error) return fail(*all.error);
  return {};
}

ServerReport LiveServer::report() const {
  const NetStats net = state_->net->stats();
  const std::scoped_lock lock(state_->mutex);
  ServerReport report = state_->report;
  report.net = net;
  report.latency = state_->net->latency();
  report.seconds = std::chrono::duration<double>(Clock::now() - state_->started).count();
  if (state_->recorder) {
    report.ticks_recorded = state_->recorder->ticks_written();
    report.record_waits = state_->recorder->waits();
    if (!report.error) report.error = state_->recorder->error();
  }
  if (state_->kept && !state_->kept->is_temporary()) report.saving = state_->kept->status();
  if (state_->pager) {
    report.paging = state_->pager->status();
    report.work.memory_mb = report.paging.memory_mb;
    report.requests_held = state_->told.paging.requests_held;
  }
  if (state_->events) report.events = state_->events->status();
  return report;
}

World* LiveServer::world() {
  return state_->feed->world();
}

std::shared_ptr<const TickDelta> LiveServer::last_delta() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->last_delta;
}

}  // namespace scree
