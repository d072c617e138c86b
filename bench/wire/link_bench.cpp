// One session by each of many simulated links, all at once on this machine: what a slow, long or torn link
// leaves of the present. Each client applies all that it gets; in the end its hash is the server's.
#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/wire/drains.h"
#include "client/cache/join_server.h"
#include "client/connection/limits.h"
#include "client/session/join_and_wait.h"
#include "server/net/net_server.h"
#include "server/world/world.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"
#include "transport/limits.h"

namespace scree {

namespace {

constexpr float interest_m = 64.0F;
constexpr Tick ticks_per_blow = 60;
constexpr uint32_t seeds_per_blow = 48;
constexpr double quiet_seconds_max = 60.0;
constexpr double wanted_beyond_ms = 250.0;

struct Link {
  double delay_ms;
  double jitter_ms;
  double kbit_s;
  uint64_t cut_bytes = 0;  ///< of the first connection; 0: none

  LinkConfig config() const {
    LinkWay way;
    way.delay_s = delay_ms / 1000.0;
    way.jitter_s = jitter_ms / 1000.0;
    way.rate_bytes_per_s = kbit_s * 125.0;
    LinkConfig link{way, way};
    if (cut_bytes != 0) link.down.cut_bytes = cut_bytes;
    return link;
  }
  /// What the link itself makes of a frame's age: the way, a full bottleneck, and the kernel's receive buffer
  /// in front of it.
  double own_ms() const {
    const double bytes = static_cast<double>(buffer_of(config().down)) + 2.0 * limits::link_receive_bytes;
    return delay_ms + jitter_ms + bytes / (kbit_s * 125.0) * 1000.0;
  }
  std::string name() const {
    const std::string cut = cut_bytes != 0 ? fmt::format("_cut_{}", cut_bytes) : "";
    return fmt::format("{}ms_{}ms_{}kbit{}", delay_ms, jitter_ms, kbit_s, cut);
  }
};

std::vector<Link> all_links(bool quick) {
  if (quick) return {{50.0, 20.0, 1000.0}, {0.0, 0.0, 100.0}};
  std::vector<Link> links;
  for (const double delay_ms : {0.0, 50.0, 200.0})
    for (const double jitter_ms : {0.0, 40.0})
      for (const double kbit_s : {10000.0, 1000.0, 300.0, 100.0})
        links.push_back({delay_ms, jitter_ms, kbit_s});
  for (const uint64_t cut_bytes : {100, 5000, 40000}) links.push_back({50.0, 20.0, 1000.0, cut_bytes});
  return links;
}

/// Kinds of messages, by what a frame may have to wait behind.
constexpr std::array<const char*, 5> kinds = {"frames", "chunks", "pieces", "status", "others"};

size_t kind_of(const ServerMessage& message) {
  return std::visit(
      Overloaded{[](const FrameMessage&) { return size_t{0}; }, [](const ChunkMessage&) { return size_t{1}; },
                 [](const PieceMessage&) { return size_t{2}; },
                 [](const StatusMessage&) { return size_t{3}; }, [](const auto&) { return size_t{4}; }},
      message);
}

/// What stands before frames: the bytes that a link delivers between the end of a frame's tick and the frame,
/// itself included, wherever they waited.
class BytesBefore {
 public:
  /// A message that has come; `before_s`: what was delivered later than that stood before it.
  void arrived(const Received& received, double now_s) {
    recent_.push_back({now_s, kind_of(received.message), received.bytes});
    if (recent_.size() > recent_max) recent_.pop_front();
  }
  void frame(double before_s) {
    ++frames_;
    for (const Arrival& arrival : recent_)
      if (arrival.at_s > before_s) bytes_[arrival.kind] += static_cast<double>(arrival.bytes);
  }
  /// The bytes of a kind before a frame, on average.
  double mean_bytes(size_t kind) const {
    return frames_ == 0 ? 0.0 : bytes_[kind] / static_cast<double>(frames_);
  }

 private:
  static constexpr size_t recent_max = 1024;
  struct Arrival {
    double at_s;
    size_t kind;
    size_t bytes;
  };
  std::deque<Arrival> recent_;
  std::array<double, kinds.size()> bytes_{};
  uint64_t frames_ = 0;
};

/// A viewer at the far end of one link, on a thread of its own.
class FarViewer {
 public:
  FarViewer(const Link& link, uint16_t port, glm::vec3 eye_m, const TickTimes& times)
      : link_(link), eye_m_(eye_m), times_(times) {
    server_.port = port;
    server_.link = link.config();
    thread_ = std::thread([this] { run(); });
  }
  ~FarViewer() { stop(); }
  FarViewer(const FarViewer&) = delete;
  FarViewer& operator=(const FarViewer&) = delete;

  void count(bool on) { counting_ = on; }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// After a status, of the field then; from any thread.
  uint64_t equal_hash() const { return equal_hash_; }

  const Link& link() const { return link_; }
  const AgeCount& ages() const { return ages_; }
  size_t connections() const { return connections_; }
  uint64_t bytes() const { return bytes_; }
  const MirrorCounters& seen() const { return seen_; }
  const BytesBefore& before() const { return before_; }
  const std::string& failure() const { return failure_; }

 private:
  void run() {
    while (!stopping_ && failure_.empty()) {
      Client client(std::make_unique<ServerConnector>(server_, std::chrono::seconds(20)));
      const auto joined = join_and_wait(client, {protocol_version, "far", eye_m_, interest_m});
      ++connections_;
      server_.link->down.cut_bytes.reset();
      if (joined)
        follow(client);
      else if (connections_ > 2)
        failure_ = joined.error().message;
    }
  }
  void follow(Client& client) {
    while (!stopping_ && client.connected()) {
      client.wait(std::chrono::milliseconds(20));
      client.poll(steady_now_s());
      while (const std::optional<Client::Event> event = client.next())
        if (const auto* applied = std::get_if<Client::Applied>(&*event))
          receive(applied->received, *client.mirror());
    }
    bytes_ += client.counters().received_bytes;
    seen_ += client.mirror()->counters();
  }
  void receive(const Received& received, Mirror& mirror) {
    const double now_s = steady_now_s();
    before_.arrived(received, now_s);
    if (const auto* frame = std::get_if<FrameMessage>(&received.message); frame && counting_) {
      ages_.add(now_s - times_.of(frame->tick));
      before_.frame(times_.of(frame->tick) + link_.delay_ms / 1000.0);
    }
    if (const auto* status = std::get_if<StatusMessage>(&received.message))
      if (status->tick == mirror.tick() && status->field_hash == mirror.field().hash())
        equal_hash_ = status->field_hash;
  }

  Link link_;
  glm::vec3 eye_m_;
  const TickTimes& times_;
  ServerEndpoint server_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> counting_{false};
  std::atomic<uint64_t> equal_hash_{0};
  AgeCount ages_;
  size_t connections_ = 0;
  uint64_t bytes_ = 0;
  MirrorCounters seen_;
  BytesBefore before_;
  std::string failure_;
};

using Viewers = std::vector<std::unique_ptr<FarViewer>>;

/// The simulation in real time, until `done` or the time is over.
class RealTime {
 public:
  RealTime(World& world, NetServer& server, CommandQueue& commands, TickTimes& times)
      : world_(world),
        server_(server),
        commands_(commands),
        times_(times),
        blows_(world.config().terrain, 5, 4.5F, 2.0F, seeds_per_blow) {}

  template <typename Done>
  void run(double seconds, bool blow, Done&& done) {
    const double end_s = steady_now_s() + seconds;
    for (double due_s = steady_now_s(); due_s < end_s && !done();
         due_s += 1.0 / world_.config().tick_rate_hz) {
      const double wait_s = due_s - steady_now_s();
      if (wait_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
      std::vector<Command> waiting = commands_.drain();
      if (blow && ticks_++ % ticks_per_blow == 0)
        if (const auto next = blows_.next()) waiting.push_back({0, static_cast<uint32_t>(ticks_), *next});
      last_ = world_.step(waiting);
      times_.published(last_->tick, steady_now_s());
      server_.publish(last_);
    }
  }
  const TickDelta& last() const { return *last_; }

 private:
  World& world_;
  NetServer& server_;
  CommandQueue& commands_;
  TickTimes& times_;
  BlowGrid blows_;
  uint64_t ticks_ = 0;
  std::shared_ptr<const TickDelta> last_;
};

void report_viewer(BenchReport& report, const FarViewer& viewer, bool equal, double seconds) {
  const Link& link = viewer.link();
  const std::string name = link.name();
  const double beyond_ms = viewer.ages().quantile_ms(0.99) - link.own_ms();
  report.metric(name + "_age_median_ms", viewer.ages().quantile_ms(0.5));
  report.metric(name + "_age_p99_ms", viewer.ages().quantile_ms(0.99));
  report.metric(name + "_age_worst_ms", viewer.ages().quantile_ms(1.0 - 1e-9));
  report.metric(name + "_frames", static_cast<double>(viewer.ages().count()));
  report.metric(name + "_kbit_s", static_cast<double>(viewer.bytes()) * 8.0 / 1000.0 / seconds);
  report.metric(name + "_patched_bricks", static_cast<double>(viewer.seen().patched_bricks));
  report.metric(name + "_chunks", static_cast<double>(viewer.seen().chunks));
  report.metric(name + "_resets", static_cast<double>(viewer.seen().resets));
  for (size_t kind = 0; kind < kinds.size(); ++kind)
    report.metric(fmt::format("{}_{}_before_bytes", name, kinds[kind]), viewer.before().mean_bytes(kind));
  const size_t wanted_connections = link.cut_bytes != 0 ? 2 : 1;
  report.check(name,
               equal && viewer.failure().empty() && viewer.ages().count() > 0 &&
                   viewer.connections() == wanted_connections && beyond_ms <= wanted_beyond_ms,
               fmt::format("hashes {}, {} connections, age p99 {:.0f} ms beyond the link's own {:.0f} ms {}; "
                           "wanted equal, {}, {:.0f} ms",
                           equal ? "equal" : "differ", viewer.connections(), beyond_ms, link.own_ms(),
                           viewer.failure(), wanted_connections, wanted_beyond_ms));
}

Result<void> run_links(const std::vector<Link>& links, double seconds, BenchReport& report) {
  World world(WorldConfig{});
  const TerrainSource& terrain = world.config().terrain;
  const glm::vec3 eye_m(0.0F, ground_height_m(terrain, 0.0F, 0.0F), 0.0F);
  CommandQueue commands;
  NetConfig net;
  net.terrain = terrain;
  net.service = world.config().service;
  const auto server = TRY(NetServer::listen(net, commands, world.keyframe()));
  const auto times = std::make_unique<TickTimes>();
  RealTime simulation(world, *server, commands, *times);
  const auto never = [] { return false; };
  simulation.run(2.0, true, never);
  const double begin_s = steady_now_s();
  Viewers viewers;
  for (const Link& link : links)
    viewers.push_back(std::make_unique<FarViewer>(link, server->port(), eye_m, *times));
  simulation.run(5.0, true, never);
  for (const auto& viewer : viewers) viewer->count(true);
  simulation.run(seconds, true, never);
  for (const auto& viewer : viewers) viewer->count(false);
  const auto equal = [&](const auto& viewer) { return viewer->equal_hash() == simulation.last().field_hash; };
  simulation.run(quiet_seconds_max, false,
                 [&] { return simulation.last().pieces.empty() && std::ranges::all_of(viewers, equal); });
  for (const auto& viewer : viewers) {
    const bool at_last = equal(viewer);
    viewer->stop();
    report_viewer(report, *viewer, at_last, steady_now_s() - begin_s);
  }
  return {};
}

}  // namespace

BenchReport run_link_bench(const BenchOptions& options) {
  BenchReport report;
  const auto ran = run_links(all_links(options.quick), options.quick ? 4.0 : 20.0, report);
  if (!ran) report.check("links", false, ran.error().message);
  return report;
}

}  // namespace scree
