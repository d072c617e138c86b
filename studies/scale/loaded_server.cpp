#include "studies/scale/loaded_server.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

#include "bench/support/cores.h"
#include "bench/support/scratch.h"
#include "bench/support/server_process.h"
#include "bench/wire/askers.h"
#include "bench/wire/drains.h"
#include "client/connection/connection.h"
#include "server/app/live_server.h"
#include "server/doors/descriptors.h"
#include "server/world/world_config.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr double viewer_interest_m = 64.0F;
constexpr double answers_wait_s = 1.1e-3 * reply_max_ms;  ///< after that every open request is too late

void wait_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Counts of a server and its clients at a moment.
struct Moment {
  double server_s, simulation_s, clients_s;
  explicit Moment(const ServerProcess& server)
      : server_s(server.cpu_s()),
        simulation_s(server.thread_cpu_s(simulation_thread_name)),
        clients_s(cpu_s(CLOCK_PROCESS_CPUTIME_ID)) {}
};

/// Ticks a second of the server, by its statuses, of which one comes a second.
double measure_ticks(Connection& connection, double seconds) {
  const double end_s = steady_now_s() + seconds;
  double first_s = 0.0, last_s = 0.0;
  Tick first = 0, last = 0;
  while (steady_now_s() < end_s)
    for (const Received& received : connection.wait(std::chrono::milliseconds(10))) {
      const auto* status = std::get_if<StatusMessage>(&received.message);
      if (status == nullptr) continue;
      last = status->tick;
      last_s = steady_now_s();
      if (first_s > 0.0) continue;
      first = last;
      first_s = last_s;
    }
  return last_s > first_s ? static_cast<double>(last - first) / (last_s - first_s) : 0.0;
}

/// Lets the requests of the measured seconds be answered, under the same load.
void wait_for_answers(const Askers& bots) {
  const double end_s = steady_now_s() + answers_wait_s;
  while (bots.counted_open() > 0 && steady_now_s() < end_s) wait_s(0.01);
}

void note_replies(const AskedTimes& times, const ServerLoad& load, ServedLoad& served) {
  const auto answered = static_cast<double>(times.reply.size()), refused = static_cast<double>(times.refused);
  std::vector<double> reply_ms;
  for (const auto& reply : times.reply) reply_ms.push_back(reply.total_ms);
  served.turns_per_s = static_cast<double>(times.turns) / load.seconds;
  served.carves_per_s = (answered - refused) / load.seconds;
  served.refused = refused / std::max(1.0, answered);
  served.reply_p99_ms = reply_p99_of(std::move(reply_ms), times.asked - times.reply.size());
}

}  // namespace

Result<ServedLoad> serve_load(const ServerLoad& load) {
  const ScratchFolder folder("scale_load");
  const std::filesystem::path program = server_program();
  if (!std::filesystem::exists(program)) return fail(program.string() + " is not built");
  raise_descriptors(load.bots + load.viewers + 1024);
  std::optional<ServerProcess> server;
  {
    const OnCores on(load.cores, OnCores::Which::first);
    server.emplace(program.c_str(), std::vector<std::string>{"--terrain", "noise", "--world",
                                                             folder / "world", "--sessions-max", "4096"});
  }
  if (server->port() == 0) return fail(program.string() + " does not start");
  const OnCores on(load.cores, OnCores::Which::others);
  WorldConfig config;
  config.terrain.kind = TerrainKind::noise;
  const float ground_m = ground_height_m(config.terrain, 0.0F, 0.0F);
  auto bots = Askers::connect({.port = server->port(),
                               .terrain = config.terrain,
                               .viewers = load.bots,
                               .apart_m = bots_apart_m,
                               .interest_m = bot_interest_m,
                               .seconds_per_carve = 1.0,
                               .radius_m = bot_radius_m,
                               .seeds = bot_seeds});
  TRY(bots);
  const auto times = std::make_unique<TickTimes>();  // of another process: nobody looks at ages
  const std::vector<HelloMessage> hellos(
      load.viewers, {protocol_version, "viewer", {0.0F, ground_m, 0.0F}, viewer_interest_m});
  auto viewers = TRY(Drains::connect(server->port(), hellos, *times));
  ServerEndpoint endpoint;
  endpoint.port = server->port();
  const auto subscriber = Connection::connect(
      endpoint, {protocol_version, "watcher", {1000.0F, ground_m, 1000.0F}, 1.0F}, std::chrono::seconds(10));
  if (!subscriber) return fail(subscriber.error().message);
  viewers->start();
  (*bots)->start();
  wait_s(load.warm_s);
  const Moment before(*server);
  (*subscriber)->poll();
  (*bots)->count(true);
  viewers->count(true);
  const double ticks_per_s = measure_ticks(**subscriber, load.seconds);
  (*bots)->count(false);
  viewers->count(false);
  const Moment after(*server);
  wait_for_answers(**bots);
  (*bots)->stop();
  viewers->stop();
  ServedLoad served;
  served.ticks_per_s = ticks_per_s;
  served.server_ms_s = (after.server_s - before.server_s) * 1e3 / load.seconds;
  served.simulation_ms_s = (after.simulation_s - before.simulation_s) * 1e3 / load.seconds;
  served.clients_ms_s = (after.clients_s - before.clients_s) * 1e3 / load.seconds;
  served.resident_mib = server->memory_mib("VmRSS");
  served.kbit_s_viewer = static_cast<double>(viewers->bytes()) * 8e-3 / load.seconds /
                         static_cast<double>(std::max<size_t>(1, load.viewers));
  served.lost = (*bots)->lost() + viewers->lost();
  note_replies((*bots)->times(), load, served);
  if (server->end(SIGTERM) != 0) return fail("the server did not end well");
  return served;
}

}  // namespace scree
