#include "bench/wire/audience.h"

#include <algorithm>
#include <chrono>
#include <malloc.h>
#include <numeric>

#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "bench/wire/paced_world.h"
#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "server/doors/descriptors.h"
#include "shared/base/memory_count.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr float interest_m = 64.0F;
constexpr Tick ticks_per_blow = 30;
constexpr uint32_t seeds_per_blow = 64;

std::vector<HelloMessage> hellos(const Spectators& audience, float ground_m) {
  Random random(audience.viewers);
  std::vector<HelloMessage> all;
  for (size_t i = 0; i < audience.viewers; ++i) {
    const glm::vec3 off =
        audience.spread_m * glm::vec3(2.0F * random.unit() - 1.0F, 0.0F, 2.0F * random.unit() - 1.0F);
    all.push_back({protocol_version, "drain", glm::vec3(0.0F, ground_m, 0.0F) + off, interest_m});
  }
  return all;
}

/// Viewers that apply everything and check every hash, on one thread.
class Mirrors {
 public:
  Result<void> join(size_t count, uint16_t port, float ground_m) {
    ServerEndpoint server;
    server.port = port;
    for (size_t i = 0; i < count; ++i) {
      clients_.push_back(
          std::make_unique<Client>(std::make_unique<ServerConnector>(server, std::chrono::seconds(20))));
      TRY(join_and_wait(*clients_.back(), {protocol_version, "mirror", {0.0F, ground_m, 0.0F}, interest_m}));
    }
    if (count > 0) thread_ = std::thread([this] { run(); });
    return {};
  }
  ~Mirrors() { stop(); }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }
  uint64_t checks() const { return counted().checks; }
  uint64_t mismatches() const { return counted().mismatches; }
  const std::string& failure() const { return failure_; }
  double cpu_s() const { return cpu_s_; }

 private:
  MirrorCounters counted() const {
    MirrorCounters sum;
    for (const auto& client : clients_)
      if (client->mirror() != nullptr) sum += client->mirror()->counters();
    return sum;
  }
  void run() {
    stand_aside();
    while (!stopping_ && failure_.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      for (const auto& client : clients_) {
        client->poll(steady_now_s());
        while (const std::optional<Client::Event> event = client->next())
          if (const auto* lost = std::get_if<Client::Lost>(&*event)) failure_ = lost->end.message;
      }
      cpu_s_ = thread_cpu_s();
    }
  }
  std::vector<std::unique_ptr<Client>> clients_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<double> cpu_s_{0.0};
  std::string failure_;
};

}  // namespace

Result<AudienceOutcome> show_storm(const Spectators& audience) {
  const size_t sessions = audience.viewers + audience.mirrors;
  WorldConfig config;
  config.service.sessions_max = static_cast<uint32_t>(sessions);
  World world(config);
  const float ground_m = ground_height_m(config.terrain, 0.0F, 0.0F);
  CommandQueue commands;
  NetConfig net;
  net.terrain = world.config().terrain;
  net.service = config.service;
  raise_descriptors(2 * sessions + 1024);
  const auto server = TRY(NetServer::listen(net, commands, world.keyframe()));
  const auto times = std::make_unique<TickTimes>();
  run_paced(world, *server, commands, *times, 0.5);
  malloc_trim(0);  // or viewers would use pages that lie free, and seem to need none
  const size_t before_bytes = process_memory_bytes();
  const auto drains = TRY(Drains::connect(server->port(), hellos(audience, ground_m), *times));
  drains->start();
  Mirrors eyes;
  TRY(eyes.join(audience.mirrors, server->port(), ground_m));
  run_paced(world, *server, commands, *times, 2.0);
  const size_t joined_bytes = process_memory_bytes();
  drains->count(true);
  const auto others_s = [&] { return cpu_s(CLOCK_PROCESS_CPUTIME_ID) - drains->cpu_s() - eyes.cpu_s(); };
  const double before_s = others_s();
  BlowGrid blows(config.terrain, 6, 4.5F, 2.0F, seeds_per_blow);
  const PacedTicks ticks = run_paced(world, *server, commands, *times, audience.seconds, [&](uint64_t tick) {
    return tick % ticks_per_blow == 0 ? blows.next() : std::nullopt;
  });
  const double busy_ms = (others_s() - before_s) * 1e3;
  drains->count(false);
  drains->stop();
  eyes.stop();
  const auto viewers = static_cast<double>(audience.viewers), run = static_cast<double>(ticks.run);
  const double simulated_ms = std::accumulate(ticks.cpu_ms.begin(), ticks.cpu_ms.end(), 0.0);
  AudienceOutcome outcome;
  outcome.ages = drains->ages();
  outcome.ticks = ticks.run;
  outcome.late_ticks = ticks.late;
  outcome.kbit_s_a_viewer = static_cast<double>(drains->bytes()) * 8.0 / 1000.0 / audience.seconds / viewers;
  outcome.kib_a_viewer =
      static_cast<double>(joined_bytes - std::min(before_bytes, joined_bytes)) / 1024.0 / viewers;
  outcome.tick_cpu_ms = simulated_ms / run;
  outcome.net_cpu_ms = std::max(0.0, busy_ms - simulated_ms) / run;
  outcome.resets = server->stats().published.resets;
  outcome.lost = drains->lost();
  outcome.checks = eyes.checks();
  outcome.mismatches = eyes.mismatches();
  outcome.failure = eyes.failure();
  return outcome;
}

}  // namespace scree
