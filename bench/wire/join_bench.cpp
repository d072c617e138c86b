// A world with 10,000 carves, on loopback: what a client gets that joins, and that comes back with what it
// has kept, in memory after a lost connection and in files after its end.
#include <atomic>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <thread>
#include <unistd.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "server/net/net_server.h"
#include "server/world/world_config.h"
#include "shared/base/timing.h"
#include "shared/field/chunk_distance.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr float half_width_m = 100.0F;
constexpr float radius_m = 1.25F;
constexpr float interest_m = 160.0F;
constexpr float near_m = 16.0F;
constexpr size_t cache_bytes = size_t{128} << 20U;
constexpr double wanted_part = 0.05;

/// A field that is carved without a simulation, its pieces gone at once, and its ticks in real time.
class CarvedWorld {
 public:
  explicit CarvedWorld(const TerrainSource& terrain)
      : field_(terrain), blows_(terrain, half_width_m, radius_m, 1, 1) {}
  ~CarvedWorld() { stop(); }

  /// The next tick has what these carves changed.
  void carve(int carves) {
    const std::scoped_lock lock(mutex_);
    std::map<BrickCoord, bool> changed;
    PieceTable pieces;
    for (int i = 0; i < carves; ++i) {
      const CarveRequest blow = blows_.next();
      const CarveOperation carve{blow.shape, blow.pattern, 1, blow.random_seed, blow.impact_m, 1};
      for (const BrickCoord brick : apply(carve, field_, pieces).changed) changed[brick] = true;
      pieces.clear();
    }
    auto delta = std::make_shared<TickDelta>();
    for (const auto& [coord, yes] : changed) {
      auto brick = std::make_shared<const Brick>(field_.brick(coord));
      delta->bricks.push_back({coord, brick, brick_hash(coord, *brick)});
    }
    next_ = std::move(delta);
  }

  void start(NetServer& server) {
    thread_ = std::thread([this, &server] {
      for (double due_s = steady_now_s(); !stopping_; due_s += 1.0 / 60.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(due_s - steady_now_s()));
        std::shared_ptr<TickDelta> delta;
        {
          const std::scoped_lock lock(mutex_);
          delta = next_ ? std::exchange(next_, nullptr) : std::make_shared<TickDelta>();
          delta->field_hash = field_.hash();
        }
        delta->tick = ++tick_;
        server.publish(delta);
      }
    });
  }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  const Field& field() const { return field_; }
  Tick tick() const { return tick_; }

 private:
  std::mutex mutex_;
  MapField field_;  ///< written under mutex_
  ScatteredBlows blows_;
  std::shared_ptr<TickDelta> next_;  ///< guarded by mutex_
  std::atomic<Tick> tick_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// What a join took.
struct Joined {
  ConnectionCounters bytes{};
  double near_s = 0.0;
  double all_s = 0.0;
  MirrorCounters counted{};
  std::string failure{};
};

bool are_equal(const std::vector<ChunkCoord>& chunks, const Field& a, const Field& b) {
  return std::ranges::all_of(chunks, [&](ChunkCoord c) { return a.chunk_hash(c) == b.chunk_hash(c); });
}

/// Joins, waits until all edits are there, and loses the connection again.
Joined join(Client& client, const Field& field, glm::vec3 eye_m) {
  std::vector<ChunkCoord> near;
  for (const ChunkCoord chunk : field.edited_chunks())
    if (distance_to_chunk_m(eye_m, chunk, field.source().voxel_size_m) <= near_m) near.push_back(chunk);
  Joined joined;
  const double begin_s = steady_now_s();
  const auto welcomed = join_and_wait(client, {protocol_version, "join", eye_m, interest_m});
  if (!welcomed) return {.failure = welcomed.error().message};
  const Mirror& mirror = *client.mirror();
  while (joined.all_s == 0.0 && steady_now_s() < begin_s + 120.0 && joined.failure.empty()) {
    client.wait(std::chrono::milliseconds(5));
    client.poll(steady_now_s());
    while (const std::optional<Client::Event> event = client.next())
      if (const auto* lost = std::get_if<Client::Lost>(&*event)) joined.failure = lost->end.message;
    if (joined.near_s == 0.0 && are_equal(near, mirror.field(), field))
      joined.near_s = steady_now_s() - begin_s;
    if (mirror.field().hash() == field.hash()) joined.all_s = steady_now_s() - begin_s;
  }
  joined.bytes = client.counters();
  joined.counted = mirror.counters();
  if (joined.all_s == 0.0 && joined.failure.empty()) joined.failure = "the edits are not all there in time";
  client.drop();
  return joined;
}

class JoinBench {
 public:
  JoinBench(BenchReport& report, CarvedWorld& world, uint16_t port)
      : report_(report),
        world_(world),
        port_(port),
        eye_m_(0.0F, ground_height_m(world.field().source(), 0.0F, 0.0F) + 2.0F, 0.0F),
        folder_(std::filesystem::temp_directory_path() / fmt::format("scree_join_bench_{}", getpid())) {}
  ~JoinBench() { std::filesystem::remove_all(folder_); }

  void run(int carves_meanwhile) {
    first_ = add("first", *client({}), "");
    {
      const auto comes_back = client(config());
      add("first_and_keeps", *comes_back, "");
      add("lost_connection", *comes_back, "rejoin");
    }
    add("next_program", *client(config()), "rejoin");
    world_.carve(carves_meanwhile);
    const Tick tick = world_.tick();
    while (world_.tick() < tick + 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    add("carved_meanwhile", *client(config()), "");
  }

 private:
  CacheConfig config() const { return {folder_.string(), cache_bytes}; }
  std::unique_ptr<Client> client(const CacheConfig& cache) const {
    ServerEndpoint server;
    server.port = port_;
    return std::make_unique<Client>(std::make_unique<ServerConnector>(server, std::chrono::seconds(5)),
                                    ClientOptions{.cache = cache});
  }

  Joined add(const std::string& name, Client& client, const std::string& kind) {
    const Joined joined = join(client, world_.field(), eye_m_);
    report_.metric(name + "_received_bytes", static_cast<double>(joined.bytes.received_bytes));
    report_.metric(name + "_sent_bytes", static_cast<double>(joined.bytes.sent_bytes));
    report_.metric(name + "_near_s", joined.near_s);
    report_.metric(name + "_all_s", joined.all_s);
    report_.metric(name + "_chunks_whole", static_cast<double>(joined.counted.chunks));
    report_.metric(name + "_chunks_kept", static_cast<double>(joined.counted.chunks_kept));
    const auto bytes = static_cast<double>(joined.bytes.received_bytes + joined.bytes.sent_bytes);
    const auto of_first = static_cast<double>(first_.bytes.received_bytes);
    const bool few = kind != "rejoin" || bytes <= wanted_part * of_first;
    report_.check(name, joined.failure.empty() && joined.counted.mismatches == 0 && few,
                  fmt::format("{:.0f} bytes both ways, {:.2f} % of the first join's{}; {} mismatches {}",
                              bytes, of_first > 0.0 ? 100.0 * bytes / of_first : 100.0,
                              kind == "rejoin" ? fmt::format(", wanted {:.0f} %", 100.0 * wanted_part) : "",
                              joined.counted.mismatches, joined.failure));
    return joined;
  }

  BenchReport& report_;
  CarvedWorld& world_;
  uint16_t port_;
  glm::vec3 eye_m_;
  std::filesystem::path folder_;
  Joined first_;
};

}  // namespace

BenchReport run_join_bench(const BenchOptions& options) {
  BenchReport report;
  const int carves = options.quick ? 500 : 10000;
  const WorldConfig config;
  CarvedWorld world(config.terrain);
  world.carve(carves);
  options.progress(0.5);
  CommandQueue commands;
  NetConfig net;
  net.terrain = config.terrain;
  const auto server = NetServer::listen(net, commands, TickDelta());
  if (!server) {
    report.check("server", false, server.error().message);
    return report;
  }
  world.start(**server);
  JoinBench(report, world, (*server)->port()).run(carves / 50);
  world.stop();
  report.metric("carves", carves);
  report.metric("edited_chunks", static_cast<double>(world.field().edited_chunks().size()));
  return report;
}

}  // namespace scree
