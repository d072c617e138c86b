// A storm seen by up to 3,000 viewers, all on this machine's cores: how old a frame is when a viewer has read
// it, from the moment in which the simulation handed it over.
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/wire/drains.h"
#include "client/connection/connection.h"
#include "client/mirror/mirror.h"
#include "server/doors/descriptors.h"
#include "server/net/net_server.h"
#include "server/world/world.h"
#include "shared/base/memory_count.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr size_t mirrors = 10;
constexpr float interest_m = 64.0F;
constexpr Tick ticks_per_blow = 30;
constexpr uint32_t seeds_per_blow = 64;

struct Crowd {
  size_t viewers;
  float spread_m;  ///< their eyes lie within this of the origin
  double wanted_p99_ms;
};

std::vector<HelloMessage> hellos(const Crowd& crowd, float ground_m) {
  Random random(crowd.viewers);
  std::vector<HelloMessage> all;
  for (size_t i = 0; i < crowd.viewers; ++i) {
    const glm::vec3 off =
        crowd.spread_m * glm::vec3(2.0F * random.unit() - 1.0F, 0.0F, 2.0F * random.unit() - 1.0F);
    all.push_back({protocol_version, "drain", glm::vec3(0.0F, ground_m, 0.0F) + off, interest_m});
  }
  return all;
}

/// Viewers that apply everything and check every hash, on one thread.
class Mirrors {
 public:
  Result<void> join(uint16_t port, float ground_m) {
    ServerEndpoint server;
    server.port = port;
    for (size_t i = 0; i < mirrors; ++i) {
      auto connected = Connection::connect(
          server, {protocol_version, "mirror", {0.0F, ground_m, 0.0F}, interest_m}, std::chrono::seconds(20));
      if (!connected) return tl::unexpected(connected.error());
      mirrors_.push_back(std::make_unique<Mirror>((*connected)->welcome()));
      connections_.push_back(std::move(*connected));
    }
    thread_ = std::thread([this] { run(); });
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

 private:
  MirrorCounters counted() const {
    MirrorCounters sum;
    for (const auto& mirror : mirrors_) sum += mirror->counters();
    return sum;
  }
  void run() {
    stand_aside();
    while (!stopping_ && failure_.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      for (size_t i = 0; i < mirrors_.size(); ++i)
        for (const Received& received : connections_[i]->poll())
          if (const auto applied = mirrors_[i]->apply(received.message); !applied)
            failure_ = applied.error().message;
    }
  }
  std::vector<std::unique_ptr<Connection>> connections_;
  std::vector<std::unique_ptr<Mirror>> mirrors_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::string failure_;
};

struct Ticks {
  uint64_t run = 0;
  uint64_t late = 0;  ///< began more than a tick after their time
};

/// The simulation in real time for so long, with blows; each tick is handed over.
Ticks simulate(World& world, NetServer& server, CommandQueue& commands, TickTimes& times, double seconds,
               bool storm) {
  const double period_s = 1.0 / world.config().tick_rate_hz;
  Ticks ticks;
  BlowGrid blows(world.config().terrain, 6, 4.5F, 2.0F, seeds_per_blow);
  const double begin_s = steady_now_s();
  double due_s = begin_s;
  while (due_s < begin_s + seconds) {
    const double wait_s = due_s - steady_now_s();
    if (wait_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    if (wait_s < -period_s) ++ticks.late;
    std::vector<Command> waiting = commands.drain();
    if (storm && ticks.run % ticks_per_blow == 0)
      if (const auto blow = blows.next()) waiting.push_back({0, static_cast<uint32_t>(ticks.run), *blow});
    const auto delta = world.step(waiting);
    times.published(delta->tick, steady_now_s());
    server.publish(delta);
    ++ticks.run;
    due_s += period_s;
  }
  server.flush();
  return ticks;
}

Result<void> run_crowd(const Crowd& crowd, double seconds, BenchReport& report) {
  WorldConfig config;
  config.service.sessions_max = static_cast<uint32_t>(crowd.viewers + mirrors);
  World world(config);
  const float ground_m = ground_height_m(config.terrain, 0.0F, 0.0F);
  CommandQueue commands;
  NetConfig net;
  net.terrain = config.terrain;
  net.service = config.service;
  raise_descriptors(2 * (crowd.viewers + mirrors) + 1024);
  const auto server = NetServer::listen(net, commands);
  if (!server) return tl::unexpected(server.error());
  const auto times = std::make_unique<TickTimes>();
  simulate(world, **server, commands, *times, 0.5, false);
  const size_t before_bytes = process_memory_bytes();
  const auto drains = Drains::connect((*server)->port(), hellos(crowd, ground_m), *times);
  if (!drains) return tl::unexpected(drains.error());
  (*drains)->start();
  Mirrors eyes;
  if (auto joined = eyes.join((*server)->port(), ground_m); !joined) return joined;
  simulate(world, **server, commands, *times, 2.0, false);
  const size_t joined_bytes = process_memory_bytes();
  (*drains)->count(true);
  const Ticks ticks = simulate(world, **server, commands, *times, seconds, true);
  (*drains)->count(false);
  (*drains)->stop();
  eyes.stop();
  const NetStats stats = (*server)->stats();
  const AgeCount& ages = (*drains)->ages();
  const std::string name = fmt::format("{}_{}", crowd.viewers, crowd.spread_m > 0.0F ? "spread" : "together");
  const auto viewers = static_cast<double>(crowd.viewers);
  const double p99_ms = ages.quantile_ms(0.99);
  const double kib =
      static_cast<double>(joined_bytes - std::min(before_bytes, joined_bytes)) / 1024.0 / viewers;
  report.metric(name + "_age_median_ms", ages.quantile_ms(0.5));
  report.metric(name + "_age_p99_ms", p99_ms);
  report.metric(name + "_age_worst_ms", ages.quantile_ms(1.0 - 1e-9));
  report.metric(name + "_frames", static_cast<double>(ages.count()));
  report.metric(name + "_kbit_s_a_viewer",
                static_cast<double>((*drains)->bytes()) * 8.0 / 1000.0 / seconds / viewers);
  report.metric(name + "_kib_a_viewer", kib);
  report.metric(name + "_late_ticks", static_cast<double>(ticks.late));
  report.metric(name + "_resets", static_cast<double>(stats.published.resets));
  report.check(
      name,
      ages.count() > 0 && p99_ms <= crowd.wanted_p99_ms && ticks.late == 0 && kib <= 64.0 &&
          (*drains)->lost() == 0 && eyes.failure().empty() && eyes.checks() > 0 && eyes.mismatches() == 0,
      fmt::format("age p99 {:.1f} ms, {} of {} ticks late, {:.0f} KiB a viewer, {} lost, {} checks with {} "
                  "mismatches {}; wanted {:.0f} ms, none, 64 KiB, none, none",
                  p99_ms, ticks.late, ticks.run, kib, (*drains)->lost(), eyes.checks(), eyes.mismatches(),
                  eyes.failure(), crowd.wanted_p99_ms));
  return {};
}

}  // namespace

BenchReport run_fanout_bench(const BenchOptions& options) {
  BenchReport report;
  const std::vector<Crowd> crowds = options.quick ? std::vector<Crowd>{{100, 0.0F, 30.0}}
                                                  : std::vector<Crowd>{{100, 0.0F, 30.0},
                                                                       {1000, 0.0F, 30.0},
                                                                       {1000, 200.0F, 30.0},
                                                                       {3000, 0.0F, 100.0},
                                                                       {3000, 200.0F, 100.0}};
  double done = 0.0;
  for (const Crowd& crowd : crowds) {
    if (const auto ran = run_crowd(crowd, options.quick ? 2.0 : 12.0, report); !ran) {
      report.check(fmt::format("{}_viewers", crowd.viewers), false, ran.error().message);
      return report;
    }
    options.progress(++done / static_cast<double>(crowds.size()));
  }
  return report;
}

}  // namespace scree
