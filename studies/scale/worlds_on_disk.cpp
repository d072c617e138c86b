#include "studies/scale/worlds_on_disk.h"

#include <atomic>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

#include "bench/support/heap.h"
#include "bench/support/machine.h"
#include "bench/support/scratch.h"
#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr double join_seconds_max = 60.0;

/// Applies all that comes until the server says that no edit waits.
Result<void> follow(Client& client) {
  const double end_s = steady_now_s() + join_seconds_max;
  while (steady_now_s() < end_s) {
    client.wait(std::chrono::milliseconds(5));
    client.poll(steady_now_s());
    while (const std::optional<Client::Event> event = client.next())
      if (const auto* lost = std::get_if<Client::Lost>(&*event)) return fail(lost->end.message);
    const Mirror& mirror = *client.mirror();
    const auto& status = mirror.status();
    if (status && status->tick == mirror.tick() && status->chunks_waiting == 0 && mirror.field().hash() != 0)
      return {};
  }
  return fail("the edits are not all there in time");
}

std::string name_of(const CarvedGround& ground) {
  const TerrainSource& terrain = ground.config.terrain;
  return fmt::format("{}_{}_{:.0f}_mm_{}_carves_of_{:.0f}_mm_{:.0f}_mm_apart", row_of(terrain.kind).name,
                     terrain.random_seed, 1000.0F * terrain.voxel_size_m,
                     ground.carves_a_side * ground.carves_a_side, 1000.0F * ground.radius_m,
                     1000.0F * ground.spacing_m);
}

}  // namespace

Result<std::vector<std::string>> worlds_on_disk(const std::string& folder,
                                                const std::vector<CarvedGround>& grounds) {
  std::vector<std::string> paths;
  for (const CarvedGround& ground : grounds) paths.push_back((fs::path(folder) / name_of(ground)).string());
  std::vector<Result<void>> written(grounds.size());
  std::atomic<int> left = static_cast<int>(grounds.size());
  const auto work = [&] {
    for (int next = --left; next >= 0; next = --left) {
      const auto i = static_cast<size_t>(next);
      if (!fs::exists(paths[i])) written[i] = write_carved_world(paths[i], grounds[i]);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < usable_cores(); ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  for (const Result<void>& one : written) TRY(one);
  return paths;
}

Result<OpenedWorld> open_world(const std::string& path, const WorldConfig& config) {
  OpenedWorld opened;
  const size_t heap_before = heap_bytes();
  const double before_s = thread_cpu_s();
  auto saved = SavedWorld::open(path, config, 1, {});
  TRY(saved);
  opened.file = std::move(*saved);
  opened.world = opened.file->release_world();
  opened.start_ms = (thread_cpu_s() - before_s) * 1e3;
  opened.heap_mib = static_cast<double>(heap_bytes() - heap_before) / (1024.0 * 1024.0);
  return opened;
}

Result<JoinCost> join_cost(const std::string& path, const WorldConfig& config, float interest_m) {
  const ScratchFolder scratch("scale_join");
  const std::string copy = scratch / "world";
  std::error_code error;
  fs::copy_file(path, copy, error);
  if (error) return fail(copy + ": " + error.message());
  LiveConfig live;
  live.world = config;
  live.world_path = copy;
  auto server = TRY(LiveServer::start(live));
  ServerEndpoint endpoint;
  endpoint.port = server->port();
  const glm::vec3 eye_m(0.0F, ground_height_m(config.terrain, 0.0F, 0.0F) + 2.0F, 0.0F);
  const double begin_s = steady_now_s();
  Client client(std::make_unique<ServerConnector>(endpoint, std::chrono::seconds(10)));
  const auto joined = join_and_wait(client, {protocol_version, "scale", eye_m, interest_m});
  if (!joined) return fail(joined.error().message);
  TRY(follow(client));
  const JoinCost cost{static_cast<double>(client.counters().received_bytes) / 1024.0,
                      steady_now_s() - begin_s, client.mirror()->held_chunks().size()};
  client.drop();
  TRY(server->stop());
  return cost;
}

}  // namespace scree
