// LiveServer's bus: a world that is told to edges, and a server that is one.
#include <fmt/format.h>

#include "crypto/signing_key.h"
#include "server/app/live_server_state.h"
#include "shared/base/wall_clock.h"

namespace scree {

Result<void> LiveServer::State::open_edge() {
  if (!config.world_path.empty() || !config.record_path.empty() || !config.events_path.empty())
    return fail("an edge keeps nothing: the simulating server does (--world, --record, --events)");
  if (config.hooks.before) return fail("an edge shows what is decided: it cannot have the hook `before`");
  feed = feed_of(config.told);
  config.world = config.told->header().world;
  const auto is_away = [told = config.told] { return told->status().away; };
  edge_pipes = std::make_shared<EdgePipes>(
      config.bus, EdgePipesConfig{config.tell.world, config.edge_name, random_number(), is_away});
  config.net.way_back = edge_pipes;
  config.net.world = config.told->world_number();
  return {};
}

/// Behind the network, which it gives persons or takes them from.
Result<void> LiveServer::State::open_bus() {
  if (edge_pipes != nullptr) {
    edge_ear = TRY(edge_pipes->open(*net));
    return {};
  }
  if (config.bus == nullptr) return {};
  if (feed->world() == nullptr) return fail("a replay is not told to edges (--nats)");
  config.tell.world_number = saved_world->number();
  teller = TRY(WorldTeller::start(config.bus, config.tell, {"scree-server " SCREE_VERSION, config.world},
                                  random_number()));
  pipe_door = TRY(PipeDoor::open(config.bus, config.tell.world, *net, config.bus_is_encrypted));
  return {};
}

/// The first call, and one after ticks were given up, hands over the world as it stands.
void LiveServer::State::tell_bus(const std::shared_ptr<const TickDelta>& delta) {
  if (teller == nullptr) return;
  if (teller->wants_start())
    teller->begin(feed->world()->keyframe(), late_chunk_reader(saved_world->path()));
  else
    teller->push(delta);
}

/// On the network thread.
void LiveServer::State::check_bus(double now_s) const {
  if (edge_pipes != nullptr) edge_pipes->check_time(now_s);
  if (pipe_door != nullptr) pipe_door->check_time(now_s);
}

void LiveServer::State::add_bus_faults(ServerHealth& found) const {
  if (teller != nullptr)
    if (const StoreHealth health = teller->status().health; !health.ok())
      found.add(HealthKind::bus,
                fmt::format("the world has not been told to edges since {}", iso_time(health.since_unix_ms)));
  if (config.told == nullptr) return;
  const ToldStatus status = config.told->status();
  if (!status.reader.connected)
    found.add(HealthKind::bus,
              fmt::format("NATS is away: this edge shows the world as of tick {}", status.tick));
  else if (status.away)
    found.add(
        HealthKind::bus,
        fmt::format("the simulating server is away: this edge shows its world as of tick {}", status.tick));
}

namespace {

void add(std::vector<Figure>& figures, FigureKind kind, const char* name, const char* help, double value) {
  figures.push_back({name, help, kind, value, {}});
}

void add_teller(std::vector<Figure>& figures, const TellerStatus& told, const PipeDoorStatus& door) {
  constexpr FigureKind total = FigureKind::total, state = FigureKind::state;
  add(figures, state, "scree_bus_connected", "1 while NATS is connected, else 0.", told.connected ? 1 : 0);
  add(figures, state, "scree_told_failing", "1 while the world is not told to edges, else 0.",
      told.health.ok() ? 0 : 1);
  add(figures, total, "scree_told_ticks_total", "Ticks that were told.", static_cast<double>(told.ticks));
  add(figures, total, "scree_told_lost_ticks_total", "Ticks that were not told.",
      static_cast<double>(told.health.lost));
  add(figures, total, "scree_told_bytes_total", "Bytes of told ticks.", static_cast<double>(told.bytes));
  add(figures, total, "scree_told_keyframes_total", "Keyframes that were told.",
      static_cast<double>(told.keyframes));
  add(figures, total, "scree_told_keyframe_bytes_total", "Their bytes.",
      static_cast<double>(told.keyframe_bytes));
  add(figures, state, "scree_told_waiting_ticks", "Ticks that wait to be told.",
      static_cast<double>(told.waiting));
  add(figures, state, "scree_edges", "Edges that were heard of in the last seconds.",
      static_cast<double>(door.edges));
  add(figures, state, "scree_edge_pipes", "Connections of persons at edges.",
      static_cast<double>(door.pipes));
  add(figures, total, "scree_edge_messages_refused_total",
      "Messages of edges that could not be read, or were too many.", static_cast<double>(door.refused));
}

void add_edge(std::vector<Figure>& figures, const ToldStatus& told, const EdgePipesStatus& pipes) {
  constexpr FigureKind total = FigureKind::total, state = FigureKind::state;
  add(figures, state, "scree_bus_connected", "1 while NATS is connected, else 0.",
      told.reader.connected ? 1 : 0);
  add(figures, state, "scree_edge_away", "1 while the simulating server is away, else 0.", told.away ? 1 : 0);
  add(figures, state, "scree_edge_tick", "The simulation's tick that the edge shows.",
      static_cast<double>(told.tick));
  add(figures, total, "scree_edge_ticks_total", "Ticks that came.", static_cast<double>(told.reader.ticks));
  add(figures, total, "scree_edge_catch_ups_total", "Times that ticks were read from the stream.",
      static_cast<double>(told.reader.catch_ups));
  add(figures, total, "scree_edge_resyncs_total", "Keyframes that were taken after the first.",
      static_cast<double>(told.resyncs));
  add(figures, total, "scree_edge_refused_total", "Messages that could not be read.",
      static_cast<double>(told.reader.refused + pipes.refused));
  add(figures, total, "scree_edge_handed_on_total", "Requests that were handed on.",
      static_cast<double>(pipes.handed_on));
  add(figures, total, "scree_edge_lost_total", "Requests that got no answer.",
      static_cast<double>(pipes.lost));
}

}  // namespace

/// The bus's, and the host's own.
std::vector<Figure> LiveServer::State::figures_beside() const {
  std::vector<Figure> figures;
  if (teller != nullptr && pipe_door != nullptr) add_teller(figures, teller->status(), pipe_door->status());
  if (config.told != nullptr) add_edge(figures, config.told->status(), edge_pipes->status());
  if (!config.hooks.figures) return figures;
  for (Figure& figure : config.hooks.figures()) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace scree
