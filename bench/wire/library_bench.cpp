// What the C interface costs over the C++ that it stands for, side by side in one program: taking the
// messages of a storm, the mesh of a chunk, 1,000 poses. Processor time of the caller's thread.
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <thread>
#include <vector>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "client/cache/join_server.h"
#include "client/library/include/scree/client.h"
#include "client/render/levels/block_windows.h"
#include "client/session/client.h"
#include "client/session/join_and_wait.h"
#include "server/app/live_server.h"
#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr float storm_m = 24.0F, blow_m = 1.8F, interest_m = 96.0F;
constexpr uint32_t seeds_a_blow = 24, ticks_between_blows = 3;
constexpr int warming_ticks = 30;
constexpr size_t poses_wanted = 1000;
/// What the C interface may take of what C++ takes, wanted.
constexpr double wanted_ratio = 1.05;
const TerrainSource ground{TerrainKind::canyon, 1, 0.25F};

/// One client by each interface, of a server that is stepped by hand.
class BothClients {
 public:
  explicit BothClients(LiveServer& server) {
    ServerEndpoint endpoint;
    endpoint.port = server.port();
    plain_ = std::make_unique<Client>(std::make_unique<ServerConnector>(endpoint));
    HelloMessage hello;
    hello.client = "bench";
    hello.interest_radius_m = interest_m;
    CHECK(join_and_wait(*plain_, hello).has_value());
    scree_options options;
    CHECK(scree_options_init(&options, sizeof options) == SCREE_OK);
    options.port = server.port();
    options.flags = SCREE_ONCE;
    options.radius_m = interest_m;
    CHECK(scree_client_create(&options, &by_c_) == SCREE_OK);
    while (c_status().connected == 0) take();
  }
  ~BothClients() { scree_client_destroy(by_c_); }
  BothClients(const BothClients&) = delete;
  BothClients& operator=(const BothClients&) = delete;

  /// Both take what has come, each by itself.
  void take() {
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    const double start_s = thread_cpu_s();
    plain_->poll(steady_now_s());
    while (plain_->next()) continue;
    const double middle_s = thread_cpu_s();
    scree_event event{};
    event.size = sizeof event;
    scree_client_poll(by_c_, 0);
    while (scree_client_next(by_c_, &event) == SCREE_OK) continue;
    c_s_ += thread_cpu_s() - middle_s;
    plain_s_ += middle_s - start_s;
  }
  /// As often as it takes for a tick's messages to come through the sockets.
  void take_tick() {
    for (int i = 0; i < 5; ++i) take();
  }
  void forget_times() { plain_s_ = c_s_ = 0.0; }

  Client& plain() { return *plain_; }
  scree_client* by_c() { return by_c_; }
  scree_status c_status() const {
    scree_status status{};
    status.size = sizeof status;
    scree_client_status(by_c_, &status);
    return status;
  }
  double plain_s() const { return plain_s_; }
  double c_s() const { return c_s_; }

 private:
  std::unique_ptr<Client> plain_;
  scree_client* by_c_ = nullptr;
  double plain_s_ = 0.0, c_s_ = 0.0;
};

void report_ratio(BenchReport& report, const std::string& name, double plain, double by_c) {
  report.metric(name + "_c_over_cpp", by_c / plain);
  report.check(name, by_c / plain <= wanted_ratio,
               fmt::format("C {:.3f} of C++, wanted at most {}", by_c / plain, wanted_ratio));
}

/// Medians of both, which take turns.
template <typename Plain, typename ByC>
std::pair<double, double> medians_us(int rounds, Plain&& plain, ByC&& by_c) {
  std::vector<double> first, second;
  for (int i = 0; i < rounds; ++i) {
    const double start_s = thread_cpu_s();
    plain();
    const double middle_s = thread_cpu_s();
    by_c();
    first.push_back((middle_s - start_s) * 1e6);
    second.push_back((thread_cpu_s() - middle_s) * 1e6);
  }
  return {quantile(first, 0.5), quantile(second, 0.5)};
}

/// Chunks with a surface that both have; the arrays of the C interface are part of its work.
void report_meshes(BenchReport& report, BothClients& both, int rounds) {
  std::vector<ChunkCoord> chunks;
  for (const ChunkCoord chunk : both.plain().mirror()->field().edited_chunks()) chunks.push_back(chunk);
  size_t plain_triangles = 0, c_triangles = 0;
  const auto [plain_us, c_us] = medians_us(
      rounds,
      [&] {
        plain_triangles = 0;
        for (const ChunkCoord chunk : chunks) {
          const VoxelCoord first = first_voxel(chunk);
          const auto windows = gather_windows(
              both.plain().field(), {first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}});
          if (windows) plain_triangles += windows->mesh(FaceEdges::sharp).indices.size() / 3;
        }
      },
      [&] {
        c_triangles = 0;
        for (const ChunkCoord chunk : chunks) {
          const int32_t at[3] = {chunk.x, chunk.y, chunk.z};
          scree_mesh mesh{};
          mesh.size = sizeof mesh;
          if (scree_client_mesh_chunk(both.by_c(), at, &mesh) != SCREE_OK) continue;
          c_triangles += mesh.index_count / 3;
          scree_mesh_release(both.by_c(), &mesh);
        }
      });
  report.metric("chunk_mesh_c_us", c_us / static_cast<double>(chunks.size()));
  report.check("same_triangles", plain_triangles == c_triangles && c_triangles > 0,
               fmt::format("{} and {}", plain_triangles, c_triangles));
  report_ratio(report, "chunk_mesh", plain_us, c_us);
}

void report_poses(BenchReport& report, BothClients& both, int rounds) {
  const Mirror& mirror = *both.plain().mirror();
  std::vector<Pose> plain(2 * poses_wanted);
  std::vector<scree_body> by_c(2 * poses_wanted);
  size_t count = 0, plain_count = 0;
  const double tick = static_cast<double>(mirror.tick()) - 1.5;
  const auto [plain_us, c_us] = medians_us(
      rounds,
      [&] {
        plain_count = 0;
        for (const auto& [id, motion] : mirror.pieces())
          if (plain_count < plain.size()) plain[plain_count++] = mirror.pose_at(motion, tick);
      },
      [&] { scree_client_bodies(both.by_c(), tick, by_c.data(), by_c.size(), &count); });
  const double thousands = static_cast<double>(count) / static_cast<double>(poses_wanted);
  report.metric("thousand_poses_c_us", c_us / thousands);
  report.check("same_pieces", count == plain_count && count > poses_wanted / 2,
               fmt::format("{} and {}", count, plain_count));
  report_ratio(report, "thousand_poses", plain_us, c_us);
}

}  // namespace

BenchReport run_library_bench(const BenchOptions& options) {
  BenchReport report;
  LiveConfig config;
  config.world.terrain = ground;
  config.world.work_percent = limits::work_percent_max;
  config.world.methods.recombine = Recombination::off;
  config.pacing = Pacing::by_hand;
  const auto server = LiveServer::start(config);
  CHECK(server.has_value());
  BothClients both(**server);
  ScatteredBlows blows(ground, storm_m, blow_m, seeds_a_blow, 1);
  const int ticks = options.quick ? 200 : 600;
  for (int i = 0; i < ticks + warming_ticks; ++i) {
    if (i == warming_ticks) both.forget_times();
    const bool crowded = both.plain().mirror()->pieces().size() > poses_wanted;
    if (i % ticks_between_blows == 0 && !crowded) CHECK((*server)->push({.body = blows.next()}));
    (*server)->step_once();
    both.take_tick();
    options.progress(static_cast<double>(i) / ticks);
  }
  for (int i = 0; i < 50 && both.c_status().field_hash != both.plain().mirror()->field().hash(); ++i)
    both.take();
  const double frames = ticks;
  report.metric("poll_c_us_a_tick", both.c_s() * 1e6 / frames);
  report.check("same_fields", both.c_status().field_hash == both.plain().mirror()->field().hash(),
               "both copies are the same");
  report_ratio(report, "poll", both.plain_s(), both.c_s());
  report_meshes(report, both, options.quick ? 7 : 25);
  report_poses(report, both, options.quick ? 200 : 1000);
  return report;
}

}  // namespace scree
