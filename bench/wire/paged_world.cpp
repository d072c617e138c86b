#include "bench/wire/paged_world.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/support/server_process.h"
#include "bench/wire/askers.h"
#include "server/bodies/bodies.h"
#include "server/store/ground_mass.h"
#include "server/store/world_file.h"
#include "server/world/recorded_values.h"
#include "server/world/state_hash.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr double tick_wanted_ms = 16.6;
constexpr size_t templates = 8;           ///< chunks that are carved; all others are like one of them
constexpr size_t chunks_per_save = 2048;  ///< one transaction
constexpr ChunkCoord carved_chunk{0, -1, 0};

struct Plan {
  uint64_t bytes;  ///< of edited bricks
  uint32_t memory_max_mb;
  double seconds;
};

/// A chunk below flat ground, full of small carves that keep away from its faces.
struct CarvedChunk {
  std::vector<BrickPatch> bricks;  ///< of carved_chunk, all 64
  MassUnits mass = 0;
};

CarvedChunk carve_chunk(const TerrainSource& terrain, uint32_t seed) {
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
  CarvedChunk chunk;
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickCoord coord = brick_in_chunk(carved_chunk, i);
    chunk.bricks.push_back({coord, field.brick(coord)});
    chunk.mass += brick_mass(chunk.bricks.back().brick);
  }
  std::ranges::sort(chunk.bricks, {}, &BrickPatch::coord);
  return chunk;
}

/// The same chunk elsewhere on level ground.
WorldChunk moved(const CarvedChunk& from, ChunkCoord to, MassUnits ground) {
  WorldChunk chunk{to, 1, 0, from.bricks, ground};
  const ChunkCoord by = to - carved_chunk;
  for (BrickPatch& patch : chunk.bricks) {
    patch.coord = patch.coord + BrickCoord{by.x * chunk_bricks, by.y * chunk_bricks, by.z * chunk_bricks};
    chunk.hash += brick_hash(patch.coord, patch.brick, patch.paint);
  }
  return chunk;
}

/// Chunks of a square around the origin, about so many.
std::vector<ChunkCoord> square_of(size_t chunks) {
  const auto half = static_cast<int>(std::sqrt(static_cast<double>(chunks)) / 2.0);
  std::vector<ChunkCoord> square;
  for (int x = -half; x < half; ++x)
    for (int z = -half; z < half; ++z) square.push_back({x, carved_chunk.y, z});
  return square;
}

/// The moment of a world that has these chunks, and nothing else happened.
WorldMoment moment_of(const WorldConfig& config, uint64_t field_hash, MassUnits gain) {
  WorldMoment moment = World(config).moment();
  moment.tick = 1;
  moment.field_hash = field_hash;
  const Ledger ledger{.terrain = gain, .dust = -gain, .moved = -gain};
  moment.ledger = to_recorded(ledger);
  MapField none(config.terrain);
  moment.state_hash =
      state_hash({moment.tick, field_hash, Bodies(none, {}).state_hash(), moment.next_piece, ledger});
  return moment;
}

/// Writes the world; the reason why not, if it cannot.
std::string make_world(BenchReport& report, const std::string& path, const Plan& plan,
                       const WorldConfig& config) {
  Stopwatch watch;
  std::vector<CarvedChunk> carved;
  for (uint32_t i = 0; i < templates; ++i) carved.push_back(carve_chunk(config.terrain, i + 1));
  MassUnits ground = 0;
  for (const int32_t mass : ground_masses(config.terrain, carved_chunk)) ground += mass;
  const std::vector<ChunkCoord> square = square_of(plan.bytes / (chunk_brick_count * sizeof(Brick)));
  uint64_t hash = 0;
  MassUnits gain = 0;
  for (size_t i = 0; i < square.size(); ++i) {
    hash += moved(carved[i % templates], square[i], ground).hash;
    gain += carved[i % templates].mass - ground;
  }
  const WorldMoment moment = moment_of(config, hash, gain);
  auto file = WorldFile::create(path, {.world = 1, .config = moment.config}, {moment, {}}, false);
  if (!file) return file.error().message;
  for (size_t first = 0; first < square.size(); first += chunks_per_save) {
    std::vector<WorldChunk> rows;
    for (size_t i = first; i < std::min(first + chunks_per_save, square.size()); ++i)
      rows.push_back(moved(carved[i % templates], square[i], ground));
    if (const auto saved = (*file)->save(moment, rows); !saved) return saved.error().message;
    const double bytes_all = static_cast<double>((*file)->bytes_written()) *
                             static_cast<double>(square.size()) / static_cast<double>(first + rows.size());
    std::error_code ignored;
    if (first == 0 &&
        bytes_all * 1.5 > static_cast<double>(fs::space(fs::path(path).parent_path(), ignored).available))
      return fmt::format("the disk has no room for {:.0f} MB", bytes_all * 1.5e-6);
  }
  size_t uniform = 0;
  for (const BrickPatch& patch : carved.front().bricks) uniform += uniform_equivalent(patch.brick) != nullptr;
  file->reset();
  report.metric("paged_chunks", static_cast<double>(square.size()));
  report.metric("paged_bricks_mib",
                static_cast<double>(square.size() * chunk_brick_count * sizeof(Brick)) / 1048576.0);
  report.metric("paged_uniform_bricks_of_64", static_cast<double>(uniform));
  report.metric("paged_file_mb", static_cast<double>(fs::file_size(path)) / 1e6);
  report.metric("paged_made_s", watch.lap_ms() * 1e-3);
  return {};
}

void note(BenchReport& report, const nlohmann::json& told, double resident_mib, const Plan& plan) {
  const auto& tick = told["stages_ms"]["whole_tick"];
  const double p99 = tick["p99"].get<double>();
  report.metric("paged_ticks", tick["count"].get<double>());
  report.metric("paged_tick_median_ms", tick["median"].get<double>());
  report.metric("paged_tick_p99_ms", p99);
  report.metric("paged_tick_worst_ms", tick["worst"].get<double>());
  report.metric("paged_carves", told["carves"].get<double>());
  for (const char* count : {"in_memory", "out", "read", "waits", "requests_held"})
    report.metric(std::string("paged_chunks_") + count, told["chunks"][count].get<double>());
  report.metric("paged_model_mb", told["work"]["memory_mb"].get<double>());
  report.check("paged_tick_p99", p99 <= tick_wanted_ms,
               fmt::format("{:.2f} ms, at most {}", p99, tick_wanted_ms));
  report.check("paged_resident", resident_mib <= plan.memory_max_mb,
               fmt::format("{:.0f} MiB, at most {}", resident_mib, plan.memory_max_mb));
  report.check("paged_ledger", told["ledger"]["error"] == 0, "error of the ledger");
}

}  // namespace

void roam_a_paged_world(BenchReport& report, const std::string& path, bool quick) {
  const Plan plan = quick ? Plan{uint64_t{64} << 20U, 256, 5.0} : Plan{uint64_t{4} << 30U, 512, 60.0};
  const fs::path program = server_program();
  if (!fs::exists(program)) {
    fmt::print(stderr, "storage: no paged world: {} is not built\n", program.string());
    return;
  }
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.memory_max_mb = plan.memory_max_mb;
  if (const std::string problem = make_world(report, path, plan, config); !problem.empty()) {
    fmt::print(stderr, "storage: no paged world: {}\n", problem);
    return;
  }
  Stopwatch watch;
  const std::string told = path + ".json";
  ServerProcess server(program.c_str(), {"--world", path, "--report", told});
  CHECK(server.port() != 0);
  report.metric("paged_start_s", watch.lap_ms() * 1e-3);
  report.metric("paged_start_resident_mib", server.most_resident_mib());
  auto viewers = Askers::connect({.port = server.port(),
                                  .terrain = config.terrain,
                                  .viewers = 8,
                                  .spread_m = quick ? 150.0F : 1300.0F,
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
  const double resident_mib = server.most_resident_mib();
  report.metric("paged_resident_most_mib", resident_mib);
  report.metric("paged_viewers_lost", static_cast<double>((*viewers)->lost()));
  report.metric("paged_asked", static_cast<double>((*viewers)->times().asked));
  report.metric("paged_refused", static_cast<double>((*viewers)->times().refused));
  CHECK(server.end(SIGTERM) == 0);
  note(report, nlohmann::json::parse(std::ifstream(told)), resident_mib, plan);
}

}  // namespace scree
