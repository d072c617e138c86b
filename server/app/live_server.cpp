#include "server/app/live_server.h"

#include <algorithm>
#include <pthread.h>

#include "server/app/limits.h"
#include "server/app/live_server_state.h"
#include "server/log/log.h"
#include "server/store/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Period at which a server that waits for its first clients counts them.
constexpr std::chrono::milliseconds wait_period{5};

}  // namespace

/// What clients are told; on the network thread.
Saving LiveServer::State::saving() const {
  const std::scoped_lock lock(mutex);
  return told;
}

/// Once a tick: how the world is kept, and where its terrain is.
void LiveServer::State::tell() {
  const SaverStatus status = saved_world->status();
  const PagerStatus paged = pager->status();
  Saving now;
  now.how = status.health.ok() ? std::string(row_of(config.durability).name) : "retrying";
  now.tick = status.saved_tick;
  if (saved_world->is_temporary()) now = {};
  if (feed->world()->tick() % config.world.tick_rate_hz == 0)
    read_last_second =
        static_cast<uint32_t>(paged.chunks_read - std::exchange(read_before, paged.chunks_read));
  now.paging = {paged.chunks_in, paged.chunks_out, read_last_second, paged.waits, admission.held()};
  const std::scoped_lock lock(mutex);
  watch.storage(status, paged);
  save_delay.note(status, steady_now_s());
  told = std::move(now);
}

void LiveServer::State::end(const std::string& error) {
  const std::scoped_lock lock(mutex);
  running = false;
  if (error.empty()) return;
  log_of(LogPart::world).error("{}", error);
  if (!report.error) report.error = error;
}

/// The world from which a part of a ring begins. Renewing bodies costs: best is a tick without any.
std::shared_ptr<const WorldMoment> LiveServer::State::begin_part(const TickDelta& delta) {
  const PartWish wish = recorder->wants_part();
  if (wish == PartWish::none || (wish == PartWish::soon && !delta.pieces.empty())) return nullptr;
  World& world = *feed->world();
  world.renew();
  return std::make_shared<const WorldMoment>(world.moment());
}

/// When the recording cannot be written, the server goes on, and the recording does so in another part.
void LiveServer::State::record(std::shared_ptr<const TickDelta> delta, std::vector<Command> carried_out,
                               std::vector<Event> noted) {
  auto part = begin_part(*delta);
  std::optional<std::vector<PlayerCursor>> cursors;
  if (delta->tick % ticks_per_physics == 0) cursors = net->cursors();
  recorder->push(std::move(delta), std::move(carried_out), std::move(noted), std::move(part),
                 std::move(cursors));
  World& world = *feed->world();
  if (recorder->wants_start()) {
    world.renew();
    recorder->begin_again(
        {world.moment(), world.keyframe(), late_chunk_reader(saved_world->path()), events->persons()});
  }
  tell_recording();
  if (world.tick() % config.world.tick_rate_hz != 0 || ring_told) return;
  const RecordingSize size = recorder->size();
  ring_told = !size.over_limit.empty();
  if (ring_told) log_of(LogPart::store).warn("{}: {}", recorder->path(), size.over_limit);
}

/// Each failure once, and its end.
void LiveServer::State::tell_recording() {
  const StoreHealth health = recorder->health();
  if (health.because == record_complaint) return;
  record_complaint = health.because;
  const auto more = log_limit.admit(health.ok() ? "recorded again" : "not recorded", steady_now_s());
  if (!more) return;
  if (health.ok())
    log_of(LogPart::store)
        .info("the recording is written again, to {}; {} ticks are in no part of it{}", recorder->path(),
              health.lost, *more);
  else
    log_of(LogPart::store)
        .warn("the recording is not written, and is tried again: {}{}", *health.because, *more);
}

/// The commands of the next tick. Nothing: the host's rule cannot go on.
std::optional<Admitted> LiveServer::State::next_commands() {
  Stopwatch stopwatch;
  Admitted admitted{commands.drain(), {}};
  World* const world = feed->world();
  if (world == nullptr) return admitted;
  world->want_physics(net->wants_physics());
  ahead->serve(world->field(), net->eyes_m());
  pager->begin_tick();
  // Steps by hand do not wait for a thread.
  TerrainAhead* const generator = config.pacing == Pacing::real_time ? ahead.get() : nullptr;
  if (history)
    for (Command& command : history->due()) admitted.commands.push_back(std::move(command));
  admitted = admission.admit(std::move(admitted.commands),
                             {*world, *pager, generator, saved_world->status().health.ok()});
  if (history) history->refused(admitted.refused);
  parts[TickPart::terrain] = stopwatch.lap_ms();
  if (config.hooks.before && !ask_host(*world, admitted)) return std::nullopt;
  parts[TickPart::rules] = stopwatch.lap_ms();
  refuse_missing_models(admitted);
  return admitted;
}

/// Runs one tick. False when it was the last.
bool LiveServer::State::step() {
  Clock::time_point begin = Clock::now();
  const double cpu_before_s = thread_cpu_s();
  Stopwatch stopwatch;
  parts = {};
  watch.begin(std::exchange(due, std::nullopt));
  auto given = next_commands();
  if (!given) return false;
  Admitted& admitted = *given;
  const bool is_chosen = add_settings(admitted.commands);
  const double terrain_in_ms = stopwatch.lap_ms();
  watch.part(&FlightTick::terrain_in_ms);
  TickSpan ran{steady_now_s(), 0.0};
  const auto next = feed->next(admitted.commands);
  ran.done_s = steady_now_s();
  begin += seconds(feed->waited_s());
  if (!next) {
    broken = true;
    end(next.error().message);
    return false;
  }
  std::shared_ptr<const TickDelta> delta = *next;
  if (!delta) {
    if (config.told == nullptr) log_of(LogPart::replay).info("the recording ends here");
    end("");
    return false;
  }
  parts[TickPart::simulation] = stopwatch.lap_ms() - 1e3 * feed->waited_s();
  watch.part(&FlightTick::world_ms);
  tell_settings(*delta);
  if (governor && is_chosen) governor->chosen(feed->world()->config().work_percent);
  if (trace) trace_tick(*trace, begin, *delta);
  std::vector<Event> noted = events ? events->drain(*delta) : std::vector<Event>();
  tell_bus(delta);
  if (recorder) {
    record(delta, std::move(admitted.commands), std::move(noted));
    watch.part(&FlightTick::record_ms);
  }
  const double record_ms = stopwatch.lap_ms();
  if (history) history->note(delta);
  if (saved_world) delta = save_and_filter(std::move(delta), std::move(admitted.refused));
  const double keep_ms = stopwatch.lap_ms();
  parts[TickPart::keep] = record_ms + keep_ms;
  watch.part(&FlightTick::keep_ms);
  const Clock::time_point handing_over = Clock::now();
  {
    const TraceSpan span(trace.get(), "simulation", "hand over");
    net->publish(delta, ran);
  }
  parts[TickPart::hand_over] = stopwatch.lap_ms();
  watch.part(&FlightTick::hand_over_ms);
  if (config.hooks.after) config.hooks.after(*delta);
  parts[TickPart::rules] += stopwatch.lap_ms();
  parts.cpu_ms = (thread_cpu_s() - cpu_before_s) * 1e3;
  flight->add(watch.end(net->load()), *delta);
  const std::scoped_lock lock(mutex);
  const double whole_ms = std::chrono::duration<double, std::milli>(handing_over - begin).count();
  report.whole_tick.add(whole_ms);
  worst_tick_ms = std::max(worst_tick_ms, whole_ms);
  report.whole_tick_cpu.add(parts.cpu_ms);
  report.terrain_in.add(terrain_in_ms);
  report.after_tick.add(keep_ms);
  report.add(*delta);
  report.add(parts);
  last_delta = delta;
  if (config.ticks_max != 0 && report.ticks >= config.ticks_max) running = false;
  if (time_is_over()) running = false;
  return running;
}

/// Saves the tick when it is due, and lets terrain go that nobody needs. Returns what clients are told: the
/// recording has no requests that never reached the simulation.
std::shared_ptr<const TickDelta> LiveServer::State::save_and_filter(std::shared_ptr<const TickDelta> delta,
                                                                    std::vector<Reply> refused) {
  World& world = *feed->world();
  admission.answered(delta->replies);
  saved_world->note(*delta, world, pager->pressed());
  const std::vector<ChunkCoord>& soon = forecast.update(*delta, world.config().terrain.voxel_size_m);
  static_cast<void>(ahead->has(world.field(), soon));
  resident->bound(world.config().memory_max_mb * bytes_per_mb * (1.0 - limits::resident_margin_share));
  pager->end_tick(*delta, saved_world->status().saved_tick, net->eyes_m(), soon,
                  world.config().memory_max_mb);
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
  while (net->stats().sessions_joined < config.wait_clients) {
    heartbeat.beat(steady_now_s());
    if (!sleep_until(Clock::now() + wait_period) || time_is_over()) return false;
  }
  return true;
}

/// Governs by a tick that took `length` of a tick's length.
void LiveServer::State::govern(double length, TickSchedule::Delay delay) {
  if (!governor) return;
  const uint32_t percent = feed->world()->config().work_percent;
  work_percent_next = governor->tick_ended(length, delay.lost_ticks, percent);
  if (work_percent_next)
    log_of(LogPart::world)
        .info("ticks {}: their work may take {} % of their length now, before it was {} %",
              *work_percent_next < percent ? "are lost" : "are in time again", *work_percent_next, percent);
}

void LiveServer::State::run() {
  ::pthread_setname_np(::pthread_self(), simulation_thread_name);
  if (!wait_for_clients()) return end("");
  if (feed->paces_itself()) {
    do heartbeat.beat(steady_now_s());
    while (sleep_until(Clock::now()) && step());
    return end("");
  }
  TickSchedule schedule(Clock::now(), period);
  while (sleep_until(schedule.due())) {
    const Clock::time_point began = Clock::now();
    due = schedule.due();
    heartbeat.beat(steady_now_s());
    if (!step()) break;
    heartbeat.beat(steady_now_s());
    const Clock::time_point ended = Clock::now();
    const TickSchedule::Delay delay = schedule.tick_ended(ended);
    count(delay);
    govern(std::chrono::duration<double>(ended - began) / period, delay);
  }
  end("");
}

LiveServer::LiveServer(std::unique_ptr<State> state) : state_(std::move(state)) {}

LiveServer::~LiveServer() {
  static_cast<void>(stop());
}

Result<std::unique_ptr<LiveServer>> LiveServer::start(const LiveConfig& config) {
  auto state = std::make_unique<State>(config);
  if (auto opened = state->open(); !opened) {
    if (state->net) state->net->stop();  // its thread asks for members that are destroyed before it
    return tl::unexpected(opened.error());
  }
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

void LiveServer::State::finish_files() {
  backups.reset();
  const double until_s = steady_now_s() + limits::last_tries_s;  // for all together
  const auto note = [this](const Result<void>& finished) {
    if (!finished) end(finished.error().message);
  };
  if (history) history->finish();
  if (saved_world && broken) saved_world->abandon();
  if (saved_world && !broken) note(saved_world->finish(*feed->world()));
  if (recorder) note(recorder->finish(std::max(0.0, until_s - steady_now_s())));
  if (events) note(events->finish());
  if (flight) note(flight->finish());
  if (teller) teller->stop();
  if (trace) note(trace->write(config.trace_path));
}

Result<void> LiveServer::stop() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
  if (!state_->finished && state_->config.hooks.stopped) state_->config.hooks.stopped();
  state_->end("");
  state_->net->stop();
  if (!std::exchange(state_->finished, true)) state_->finish_files();
  const ServerReport all = report();
  if (all.error) return fail(*all.error);
  return {};
}

ServerReport LiveServer::report() const {
  return state_->report_now(state_->net->stats(), state_->net->latency());
}

World* LiveServer::world() {
  return state_->feed->world();
}

std::shared_ptr<const TickDelta> LiveServer::last_delta() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->last_delta;
}

}  // namespace scree
