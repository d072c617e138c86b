// LiveServer's opening: world, network, recording, log of events.
#include <filesystem>
#include <set>

#include "server/app/ground_giver.h"
#include "server/app/live_server_state.h"
#include "server/app/memory_limit.h"
#include "server/app/prop_models.h"
#include "server/app/world_materials.h"
#include "server/log/log.h"
#include "server/replay/recorded_field.h"
#include "server/work/memory.h"
#include "server/world/settings.h"
#include "server/world/world_snapshot.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"

namespace scree {

Result<void> LiveServer::State::open() {
  config.net.service = config.world.service;                     // those of a recording are not this server's
  const uint32_t work_percent_most = config.world.work_percent;  // a kept world may have less, of a busy hour
  const Digest given = config.world.ground;
  std::optional<Spawn> spawn;  // of a replay
  const bool keeps = !config.record_path.empty() || !config.world_path.empty();
  CHECK(!keeps || config.world.terrain.heights == nullptr || given != Digest{});
  if (config.told != nullptr) {
    TRY(open_edge());
  } else if (!config.replay.path.empty()) {
    TRY(open_replay(spawn));
  } else if (auto opened = open_world(); !opened) {
    return opened;
  }
  if (config.world.ground != given && given != Digest{})
    return fail(config.world_path + config.replay.path + ": its terrain is generated, not the ground " +
                hex_of(given) + " (--ground)");
  pass_on_hooks();
  TRY(open_records());  // first: it makes no file, so nothing is left where it is refused
  TRY(open_history());
  config.net.health = [this] { return health(); };
  config.net.checked = [this](double now_s) { check_heartbeat(now_s); };
  config.net.takes_cursors = !config.record_path.empty();
  const World* const simulated = feed->world();
  config.net.terrain = simulated != nullptr ? simulated->config().terrain : config.world.terrain;
  config.net.tick_rate_hz = config.world.tick_rate_hz;
  config.net.palette = config.world.palette;
  config.net.images = config.images;
  config.net.models = config.models;
  tell_missing_images(*config.world.palette, config.images.get());
  period = seconds(1.0 / static_cast<double>(config.world.tick_rate_hz));
  TRY(open_events());
  TRY(open_flight());
  // The port comes first: a server that cannot listen leaves no empty recording behind.
  World* const world = feed->world();
  TickDelta keyframe = world != nullptr         ? world->keyframe()
                       : config.told != nullptr ? std::move(*config.told->keyframe())
                                                : TickDelta();
  if (spawn) keyframe.spawn = spawn;
  end_old_sessions(keyframe);
  tell_missing_models(keyframe.props_spawned, config.models.get());
  report.settings = keyframe.settings;  // ticks say only what changes
  auto listening = NetServer::listen(config.net, commands, std::move(keyframe));
  if (!listening) forget_history();
  TRY(listening);
  net = std::move(*listening);
  if (config.hooks.started) config.hooks.started(host_acts());
  TRY(open_recorder());
  TRY(open_bus());
  if (saved_world != nullptr) TRY(start_saving());
  if (world != nullptr) {
    tell_memory_limit();
    ahead = std::make_unique<TerrainAhead>(config.world.terrain);
    if (config.governed)
      governor = std::make_unique<LoadGovernor>(config.world.tick_rate_hz, work_percent_most);
  }
  if (!config.trace_path.empty()) trace = std::make_unique<Trace>();
  heartbeat.beat(steady_now_s());
  is_open = true;
  return {};
}

/// Something else than this server decided what happens.
Result<void> LiveServer::State::open_replay(std::optional<Spawn>& spawn) {
  if (!config.record_path.empty())
    return fail("a replay is not recorded again: copy " + config.replay.path + " instead (--record)");
  if (!config.world_path.empty()) return fail("a replay has no world to keep (--world)");
  if (config.hooks.before)
    return fail("a replay plays commands that are decided: it cannot have the hook `before`");
  if (!config.events_path.empty())
    return fail("a replay's events are its recording's: scree replay export (--events)");
  auto replay = TRY(replay_feed(config.replay, ground_giver(config.replay.path, config.world),
                                config.net.ticks_per_transform));
  feed = std::move(replay.feed);
  config.world = replay.world;
  spawn = replay.spawn;
  config.net.replay = true;
  config.net.control = [this](const ControlReplayRequest& wish) { return feed->control(wish); };
  return {};
}

void LiveServer::State::pass_on_hooks() {
  config.net.said = config.hooks.said;
  config.net.joined = [this](const JoinedPerson& person) {
    flight->name(person.session, person.name);
    if (history) history->joined(person);
    if (config.hooks.joined) config.hooks.joined(person);
  };
  config.net.left = config.hooks.left;
  config.net.heard = config.hooks.heard;
  config.net.control_rules = config.hooks.controlled;
}

/// They were another process's, and never go on.
void LiveServer::State::end_old_sessions(const TickDelta& keyframe) {
  std::set<uint64_t> sessions;
  for (const PersonPlace& person : keyframe.persons) sessions.insert(person.session);
  if (keyframe.players != nullptr)
    for (const Player& player : *keyframe.players) sessions.insert(player.session);
  if (keyframe.signs != nullptr)
    for (const Sign& sign : *keyframe.signs)
      if (sign.to.kind == AudienceKind::session) sessions.insert(sign.to.session);
  for (const uint64_t session : sessions)
    if (!commands.push({session, 0, LeaveRequest{}}))
      log_of(LogPart::net, session)
          .warn("the person of session {} stays, though the session is over", session);
}

Result<void> LiveServer::State::open_world() {
  const std::string& path = config.world_path;
  auto opened = path.empty() ? SavedWorld::open_temporary(config.world, config.sim_threads)
                             : SavedWorld::open(path, config.world, config.sim_threads,
                                                ground_giver(path, config.world), config.bricks_in_max,
                                                config.machine_limits, config.materials);
  TRY(opened);
  saved_world = std::move(*opened);
  feed = feed_of(saved_world->release_world());
  config.world = feed->world()->config();
  limits_to_set = differing(config.machine_limits, config.world);
  WorldConfig from_first_tick = config.world;
  TRY(set_all(from_first_tick, limits_to_set));
  config.net.service = from_first_tick.service;
  config.net.world = saved_world->number();
  config.net.first_session = saved_world->first_session();
  config.net.chunks = for_clients;
  config.net.saving = [this] { return saving(); };
  report.world_path = path;
  return {};
}

/// The file of a new world is made here.
Result<void> LiveServer::State::start_saving() {
  SaverConfig keeping{config.durability, config.autosave_s, config.world.tick_rate_hz, {}};
  if (saved_world->is_temporary()) keeping.durability = Durability::off, keeping.autosave_s = 0.0;
  keeping.before_save = [this](Tick tick) {
    if (recorder) recorder->commit_up_to(tick);
    if (history) history->commit_up_to(tick);
  };
  World& world = *feed->world();
  TRY(saved_world->start(world, std::move(keeping)));
  resident = std::make_unique<ResidentMemory>();
  auto opened = TerrainPager::open(saved_world->path(), world.paging(), for_clients, config.bricks_in_max,
                                   [seen = resident.get()] { return seen->bytes(); });
  TRY(opened);
  pager = std::move(*opened);
  if (config.backups.every_s > 0.0) {
    auto started = TRY(Backups::start(saved_world->path(), config.backups));
    backups = std::move(started);
  }
  tell();
  return {};
}

Result<void> LiveServer::State::open_recorder() {
  if (config.record_path.empty()) return {};
  const RecordingHeader header{"scree-server " SCREE_VERSION, config.world};
  World& world = *feed->world();
  std::error_code ignored;  // a kept world may stand at tick 0 again: ended at once, or rolled back
  const bool goes_on = world.tick() > 0 || (saved_world && !saved_world->is_new() &&
                                            std::filesystem::exists(config.record_path, ignored));
  // Its terrain comes chunk by chunk: it may be larger than memory.
  std::optional<RecordingStart> from;
  if (goes_on) from = RecordingStart{world.moment(), world.outline(), reader_of(world)};
  auto recording = Recorder::open(config.record_path, header, from ? &*from : nullptr, config.record_ring);
  TRY(recording);
  recorder = std::move(*recording);
  report.record_path = config.record_path;
  return {};
}

/// The terrain of a tick comes out of the recording, where there is one.
Result<void> LiveServer::State::open_history() {
  if (saved_world == nullptr || config.history_mb == 0) return {};
  World& world = *feed->world();
  HistoryConfig keeping{.path = saved_world->path() + ".history",
                        .world = saved_world->number(),
                        .tick = world.tick(),
                        .tick_rate_hz = config.world.tick_rate_hz,
                        .voxel_size_m = config.world.terrain.voxel_size_m,
                        .mb_max = config.history_mb};
  TerrainThen then;
  if (!config.record_path.empty())
    then = [this](Tick tick) -> Result<std::unique_ptr<Field>> {
      if (!recorder) return std::unique_ptr<Field>();
      recorder->commit_up_to(tick);
      return field_at(recorder->path(), tick, ground_giver(config.world_path, config.world));
    };
  auto opened = EditHistory::open(keeping, std::move(then));
  TRY(opened);
  history = std::move(*opened);
  world.want_replaced(true);
  config.net.ask_history = [this](uint64_t session, uint32_t request, const HistoryAct& asked,
                                  const std::string& who) { answer_history(session, request, asked, who); };
  return {};
}

/// A process that goes beyond what its machine or container has is ended without a word.
void LiveServer::State::tell_memory_limit() const {
  const double limit_mb = memory_limit_bytes() / bytes_per_mb;
  const uint32_t wanted_mb = feed->world()->config().memory_max_mb;
  if (limit_mb == 0.0 || wanted_mb <= limit_mb) return;
  log_of(LogPart::app)
      .warn(
          "memory-max is {} MB, and the machine or its container gives {:.0f} MB: a world that grows is "
          "ended "
          "by the system before the server refuses edits. Set memory-max lower, or give it more memory",
          wanted_mb, limit_mb);
}

/// What operators and administrators read. A replay, and a world that ends with its server, have no file of
/// what administrators did.
Result<void> LiveServer::State::open_records() {
  const bool kept = saved_world != nullptr && !saved_world->is_temporary();
  audit = std::make_unique<AuditTrail>(TRY(AuditTrail::open(kept ? saved_world->path() + ".audit" : "")));
  config.net.records = {[this](LinesOf of) { return lines(of); },
                        [this](const std::string& who, const std::string& act) { audit->add(who, act); }};
  config.net.status = [this](const NetFigures& figures) { return status(figures); };
  config.net.metrics = [this](const NetFigures& figures) { return metrics(figures); };
  return {};
}

/// That of a world which has no file either.
void LiveServer::State::forget_history() {
  if (history == nullptr || !saved_world->is_new()) return;
  history.reset();
  std::error_code ignored;
  for (const char* part : {"", "-wal", "-shm"})
    std::filesystem::remove(saved_world->path() + ".history" + part, ignored);
}

/// On the network's thread; the answer comes from the history's.
void LiveServer::State::answer_history(uint64_t session, uint32_t request, const HistoryAct& asked,
                                       const std::string& who) {
  const auto answer = [this, session, request](Result<std::string> said) {
    if (said)
      net->send(session, ServerMessage(AdminListMessage{.request = request, .text = std::move(*said)}));
    else
      net->send(session, ServerMessage(ReplyMessage{request, said.error().message, 0}));
  };
  std::visit(Overloaded{[&](const HistoryRequest& history_asked) { history->ask(history_asked, answer); },
                        [&](const UndoRequest& undo) { history->ask(undo, who, answer); }},
             asked);
}

Result<void> LiveServer::State::open_events() {
  if (!has_events()) return {};
  auto opened = TRY(LiveEvents::open(config.events_path, config.world, print(config.world)));
  events = std::move(opened);
  config.net.noted = [this](Event event) { events->note(std::move(event)); };
  if (const World* world = feed->world(); world->tick() > 0)
    events->note({.kind = EventKind::rebuild, .text = config.world_path});
  report.events_path = config.events_path;
  return {};
}

}  // namespace scree
