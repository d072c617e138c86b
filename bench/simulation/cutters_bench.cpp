// The three cutters, each with the three simplifiers: the same blows, as a server's tick carries them out.
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "bench/support/benches.h"
#include "bench/support/heap.h"
#include "bench/support/scenes.h"
#include "bench/support/surface_distance.h"
#include "server/fracture/hull.h"
#include "shared/base/timing.h"
#include "shared/field/edit.h"
#include "shared/fracture/conform_cutter.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/slice_cutter.h"

namespace scree {

namespace {

constexpr int ticks_after_blow = 120;

struct Method {
  std::string name;
  Cutter cutter;
  Simplifier simplifier;
};

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const Cutter cutter : all_kinds<Cutter>)
    for (const Simplifier simplifier : all_kinds<Simplifier>)
      methods.push_back({fmt::format("{}_{}", name_of(cutter), name_of(simplifier)), cutter, simplifier});
  return methods;
}

struct Sums {
  std::vector<double> cut_ms, bodies_ms, after_ms;
  double pieces = 0.0, points = 0.0, peak_bytes = 0.0, piece_bytes = 0.0;
  double mass = 0.0, codes = 0.0, shape_error_m3 = 0.0, size_m3 = 0.0;
};

double codes_volume(const Window& window) {
  double sum = 0.0;
  for (const Code code : window.codes) sum += occupancy(code);
  return sum;
}

void add_pieces(const TickDelta& delta, const Method& method, float voxel_size_m, Sums& sums) {
  for (const SpawnedPiece& piece : delta.spawned) {
    const PieceHull hull = make_hull(piece.id, *piece.volume, voxel_size_m, method.simplifier);
    sums.pieces += 1.0;
    sums.points += static_cast<double>(hull.corners_m.size());
    sums.piece_bytes +=
        static_cast<double>(piece.volume->window.codes.size() + hull.corners_m.size() * sizeof(glm::vec3));
    sums.mass += static_cast<double>(piece.volume->mass);
    sums.codes += codes_volume(piece.volume->window);
    sums.shape_error_m3 += std::abs(hull_volume(hull.corners_m) - static_cast<double>(hull.size_m3));
    sums.size_m3 += static_cast<double>(hull.size_m3);
  }
}

Sums blow_up(const Method& method, int carves) {
  WorldConfig config;
  config.methods.cutter = method.cutter;
  config.methods.simplifier = method.simplifier;
  World world(config);
  ScatteredBlows blows(config.terrain, 50.0F, 2.0F, 64, 11);
  Sums sums;
  for (int i = 0; i < carves; ++i) {
    const CarveRequest blow = blows.next();
    gather(world.field(), band_box(in_voxels(blow.shape, config.terrain.voxel_size_m)).grown(chunk_size));
    const Command command{0, static_cast<uint32_t>(i), blow};
    const size_t held = heap_bytes();
    reset_heap_peak();
    const auto delta = world.step({&command, 1});
    sums.peak_bytes += static_cast<double>(heap_peak_bytes() - held);
    sums.cut_ms.push_back(delta->times[TickStage::requests]);
    sums.bodies_ms.push_back(delta->times[TickStage::spawn]);
    add_pieces(*delta, method, config.terrain.voxel_size_m, sums);
    for (int tick = 0; tick < ticks_after_blow; ++tick)
      sums.after_ms.push_back(world.step({})->times[TickStage::bodies]);
  }
  return sums;
}

/// Corners of a part, each once: `conform` gives every face its own.
size_t corners_of(const PolygonMesh& part) {
  constexpr double same = 1e-6;
  std::set<std::tuple<int64_t, int64_t, int64_t>> corners;
  for (const glm::dvec3& p : part.vertices) {
    const auto step = [](double x) { return static_cast<int64_t>(std::floor(x / same + 0.5)); };
    corners.emplace(step(p.x), step(p.y), step(p.z));
  }
  return corners.size();
}

/// How far the polygons of the parts are from those of the whole, as a share of its volume: the worst blow.
/// How many corners a part has, and how long the polygons took, without turning them into codes.
struct Conservation {
  double error = 0.0;
  double vertices = 0.0;
  double median_ms = 0.0;
};

Conservation conservation_of(const PolygonCutting& cutting, int carves) {
  const WorldConfig config;
  const float dx = config.terrain.voxel_size_m;
  ScatteredBlows blows(config.terrain, 50.0F, 2.0F, 64, 11);
  Conservation result;
  size_t parts = 0;
  std::vector<double> times_ms;
  for (int i = 0; i < carves; ++i) {
    const CarveRequest blow = blows.next();
    MapField field(config.terrain);
    const Shape shape = in_voxels(blow.shape, dx);
    const Window before = gather(field, band_box(shape));
    const Window volume = extract(before, codes_of(shape, before.box));
    const auto seeds = scatter_seeds(volume, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m / dx);
    Stopwatch stopwatch;
    const PolygonParts cut = cut_polygons(cutting, volume, seeds);
    times_ms.push_back(stopwatch.lap_ms());
    double sum = 0.0;
    for (const PolygonMesh& part : cut.parts) {
      sum += moments_of(part).volume;
      result.vertices += static_cast<double>(corners_of(part));
      parts += part.empty() ? 0 : 1;
    }
    const double whole = moments_of(cut.whole).volume;
    result.error = std::max(result.error, std::abs(sum - whole) / whole);
  }
  result.vertices /= static_cast<double>(parts);
  result.median_ms = quantile(times_ms, 0.5);
  return result;
}

void report_method(BenchReport& report, const Method& method, const Sums& sums, int carves) {
  const auto metric = [&](const char* name, double value) {
    report.metric(fmt::format("{}_{}", method.name, name), value);
  };
  metric("cut_median_ms", quantile(sums.cut_ms, 0.5));
  metric("make_bodies_median_ms", quantile(sums.bodies_ms, 0.5));
  metric("bodies_tick_median_ms", quantile(sums.after_ms, 0.5));
  metric("points_per_piece", sums.points / sums.pieces);
  metric("codes_volume_error", std::abs(sums.codes - sums.mass) / sums.mass);
  metric("body_volume_error", sums.shape_error_m3 / sums.size_m3);
  metric("peak_heap_kib", sums.peak_bytes / carves / 1024.0);
  metric("piece_bytes", sums.piece_bytes / sums.pieces);
}

}  // namespace

BenchReport run_cutters_bench(const BenchOptions& options) {
  const int carves = options.quick ? 2 : 20;
  BenchReport report;
  const std::vector<Method> methods = all_methods();
  std::vector<double> pieces;
  for (size_t i = 0; i < methods.size(); ++i) {
    const Sums sums = blow_up(methods[i], carves);
    pieces.push_back(sums.pieces / carves);
    report_method(report, methods[i], sums, carves);
    options.progress(static_cast<double>(i + 1) / static_cast<double>(methods.size() + 1));
  }
  for (const auto& [cutter, cutting] :
       {std::pair(Cutter::slice, slice_cutting), std::pair(Cutter::conform, conform_cutting)}) {
    const std::string_view name = name_of(cutter);
    const Conservation conservation = conservation_of(cutting, carves);
    report.metric(fmt::format("{}_polygons_median_ms", name), conservation.median_ms);
    report.metric(fmt::format("{}_polygon_vertices_per_part", name), conservation.vertices);
    report.metric(fmt::format("{}_polygon_volume_error", name), conservation.error);
    report.check(fmt::format("{}_conserves_volume", name), conservation.error <= 1e-3,
                 fmt::format("{:.2g} of the volume at worst, wanted at most 1e-3", conservation.error));
  }
  options.progress(1.0);
  report.metric("pieces_per_carve", pieces.front());
  return report;
}

}  // namespace scree
