#include "bench/wire/paged_world.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/support/made_world.h"
#include "bench/support/server_process.h"
#include "bench/wire/askers.h"
#include "server/app/temporary_world.h"
#include "server/store/ground_mass.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr double tick_wanted_ms = 16.6;
constexpr double starts_within_s = 600.0;  ///< the server, which looks through the whole world first
constexpr size_t templates = 8;            ///< chunks that are carved; all others are like one of them
constexpr size_t looked_at = 1024;         ///< chunks after which the disk's room is looked at
constexpr ChunkCoord carved_chunk{0, -1, 0};

/// All bricks of carved_chunk, below flat ground, full of small carves that keep away from its faces.
std::vector<BrickPatch> carve_chunk(const TerrainSource& terrain, uint32_t seed) {
  MapField field(terrain);
  PieceTable pieces;
  Random random(seed);
  const auto along = [&] { return 1.6F + 4.8F * random.unit(); };
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 at_m{along(), along() - 8.0F, along()};
    CarveOperation carve;
    carve.shape = sphere(at_m, 0.5F + 0.5F * random.unit());
    carve.seeds = 1;
    carve.random_seed = random.next();
    carve.impact_m = at_m;
    carve.first_piece = 1;
    apply(carve, field, pieces);
    pieces.clear();
  }
  std::vector<BrickPatch> bricks;
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickCoord coord = brick_in_chunk(carved_chunk, i);
    bricks.push_back({coord, field.brick(coord)});
  }
  std::ranges::sort(bricks, {}, &BrickPatch::coord);
  return bricks;
}

/// The same bricks elsewhere on level ground.
std::vector<BrickPatch> moved(std::vector<BrickPatch> bricks, ChunkCoord to) {
  const ChunkCoord by = to - carved_chunk;
  for (BrickPatch& patch : bricks)
    patch.coord = patch.coord + BrickCoord{by.x * chunk_bricks, by.y * chunk_bricks, by.z * chunk_bricks};
  return bricks;
}

size_t chunks_of(const RoamPlan& plan) {
  return (size_t{plan.world_mb} << 20U) / (chunk_brick_count * sizeof(Brick));
}

/// Chunks of a square around the origin, about so many.
std::vector<ChunkCoord> square_of(size_t chunks) {
  const auto half = static_cast<int>(std::sqrt(static_cast<double>(chunks)) / 2.0);
  std::vector<ChunkCoord> square;
  for (int x = -half; x < half; ++x)
    for (int z = -half; z < half; ++z) square.push_back({x, carved_chunk.y, z});
  return square;
}

/// Writes the world; an error when it cannot.
Result<void> make_world(BenchReport& report, const RoamPlan& plan, const WorldConfig& config) {
  Stopwatch stopwatch;
  std::vector<std::vector<BrickPatch>> carved;
  for (uint32_t i = 0; i < templates; ++i) carved.push_back(carve_chunk(config.terrain, i + 1));
  MassUnits ground = 0;
  for (const int32_t mass : ground_masses(config.terrain, carved_chunk)) ground += mass;
  const std::vector<ChunkCoord> square = square_of(chunks_of(plan));
  auto world = TRY(MadeWorld::create(plan.made, config));
  for (size_t i = 0; i < square.size(); ++i) {
    TRY(world.add(square[i], moved(carved[i % templates], square[i]), ground));
    if (i + 1 != looked_at) continue;
    const double bytes = static_cast<double>(world.bytes_written() * square.size()) / looked_at;
    std::error_code ignored;
    if (bytes * 2.5 > static_cast<double>(fs::space(fs::path(plan.made).parent_path(), ignored).available))
      return fail(fmt::format("the disk has no room for {:.0f} MB", bytes * 2.5e-6));
  }
  TRY(world.finish());
  report.metric("paged_made_s", stopwatch.lap_ms() * 1e-3);
  return {};
}

void note(BenchReport& report, const nlohmann::json& told, double resident_mib, const RoamPlan& plan) {
  const auto& stages = told["stages_ms"];
  for (const auto& [name, stage] : stages.items())
    for (const char* value : {"median", "p99", "worst"})
      report.metric(fmt::format("paged_{}_{}_ms", name, value), stage[value].get<double>());
  const double p99 = stages["whole_tick"]["p99"].get<double>();
  const double p99_cpu = stages["whole_tick_cpu"]["p99"].get<double>();
  report.metric("paged_ticks", stages["whole_tick"]["count"].get<double>());
  report.metric("paged_late_ticks", told["late_ticks"].get<double>());
  report.metric("paged_carves", told["carves"].get<double>());
  for (const char* count : {"in_memory", "out", "read", "waits", "requests_held"})
    report.metric(std::string("paged_chunks_") + count, told["chunks"][count].get<double>());
  report.metric("paged_model_mb", told["work"]["memory_mb"].get<double>());
  report.check("paged_tick_p99", p99 <= tick_wanted_ms,
               fmt::format("{:.2f} ms, {:.2f} of processor time, at most {}", p99, p99_cpu, tick_wanted_ms));
  report.check("paged_resident", resident_mib <= plan.memory_max_mb,
               fmt::format("{:.0f} MiB, at most {}", resident_mib, plan.memory_max_mb));
  report.check("paged_ledger", told["ledger"]["error"] == 0, "error of the ledger");
}

/// Starts the server, and lets viewers roam.
void roam(BenchReport& report, const RoamPlan& plan, const WorldConfig& config, const char* program) {
  Stopwatch stopwatch;
  const std::string told = plan.roamed + ".json";
  ServerProcess server(program, {"--world", plan.roamed, "--report", told}, starts_within_s);
  CHECK(server.port() != 0);
  report.metric("paged_start_s", stopwatch.lap_ms() * 1e-3);
  report.metric("paged_start_resident_most_mib", server.memory_mib("VmHWM"));
  report.metric("paged_start_resident_mib", server.memory_mib("VmRSS"));
  const float side_m =
      std::sqrt(static_cast<float>(chunks_of(plan))) * chunk_size * config.terrain.voxel_size_m;
  auto viewers = Askers::connect({.port = server.port(),
                                  .terrain = config.terrain,
                                  .viewers = 8,
                                  .spread_m = 0.45F * side_m,
                                  .interest_m = 48.0F,
                                  .seconds_per_carve = 1.0,
                                  .radius_m = 1.5F,
                                  .seeds = 16,
                                  .speed_m_s = 8.0F});
  CHECK(viewers.has_value());
  (*viewers)->start();
  (*viewers)->count(true);
  std::this_thread::sleep_for(std::chrono::duration<double>(plan.seconds));
  (*viewers)->stop();
  const double resident_mib = server.memory_mib("VmHWM");
  report.metric("paged_resident_most_mib", resident_mib);
  report.metric("paged_resident_mib", server.memory_mib("VmRSS"));
  report.metric("paged_resident_file_mib", server.memory_mib("RssFile"));
  report.metric("paged_viewers_lost", static_cast<double>((*viewers)->lost()));
  report.metric("paged_asked", static_cast<double>((*viewers)->times().asked));
  report.metric("paged_refused", static_cast<double>((*viewers)->times().refused));
  CHECK(server.end(SIGTERM) == 0);
  note(report, nlohmann::json::parse(std::ifstream(told)), resident_mib, plan);
  fs::remove(told);
}

}  // namespace

void roam_a_paged_world(BenchReport& report, const RoamPlan& plan) {
  const fs::path program = server_program();
  if (!fs::exists(program)) {
    fmt::print(stderr, "storage: no paged world: {} is not built\n", program.string());
    return;
  }
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.memory_max_mb = plan.memory_max_mb;
  std::error_code error;
  if (!fs::exists(plan.made)) {
    if (const auto made = make_world(report, plan, config); !made)
      return fmt::print(stderr, "storage: no paged world: {}\n", made.error().message);
  }
  fs::copy_file(plan.made, plan.roamed, fs::copy_options::overwrite_existing, error);
  if (error) {
    fmt::print(stderr, "storage: no paged world: {}: {}\n", plan.roamed, error.message());
    return remove_world(plan.roamed);
  }
  report.metric("paged_world_mib", plan.world_mb);
  report.metric("paged_file_mb", static_cast<double>(fs::file_size(plan.made)) / 1e6);
  roam(report, plan, config, program.c_str());
  remove_world(plan.roamed);
}

}  // namespace scree
