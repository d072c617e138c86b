// Merging the pieces of a carve into terrain elsewhere, by each method: time, mass and shape, beside
// OpenVDB's stock way.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "bench/peers/stock_fracture.h"
#include "bench/support/benches.h"
#include "bench/support/surface_distance.h"
#include "shared/base/timing.h"
#include "shared/field/edit.h"
#include "shared/operation/operation.h"
#include "shared/operation/prepared_stamp.h"
#include "shared/operation/stamp_groups.h"
#include "shared/recombine/stamp_method.h"

namespace scree {

namespace {

constexpr float voxel_size_m = 0.25F;
constexpr float radius_m = 2.0F;
constexpr uint32_t seeds = 64;
const TerrainSource source{TerrainKind::noise, 1, voxel_size_m};

/// The carve that all pieces come from.
glm::vec3 carve_centre() {
  return {0.0F, ground_height_m(source, 0.0F, 0.0F) - 0.8F, 0.0F};
}

CarveOperation carve_operation(uint32_t random_seed) {
  return {sphere(carve_centre(), radius_m), SeedPattern::uniform, seeds, random_seed, carve_centre(), 1};
}

/// The figures of one method: medians over the rounds of a piece's mean time, the mean error, and the worst
/// of everything else.
struct MethodFigures {
  std::vector<double> plan_us;  ///< gather, and find the shift
  std::vector<double> apply_us;
  double error_worst_percent = 0.0;
  double error_sum_percent = 0.0;
  size_t pieces = 0;
  double rms_voxels = 0.0;

  double piece_us() const { return quantile(plan_us, 0.5) + quantile(apply_us, 0.5); }
};

void add_error(MethodFigures& figures, MassUnits gain, MassUnits mass) {
  const double error = 100.0 * std::abs(static_cast<double>(gain - mass)) / static_cast<double>(mass);
  figures.error_worst_percent = std::max(figures.error_worst_percent, error);
  figures.error_sum_percent += error;
  ++figures.pieces;
}

/// One round: every piece of a carve, each with no more than its own mass to gain.
void merge_all(StampMethod method, Field& field, PieceTable pieces, const std::vector<Pose>& poses,
               MethodFigures& figures) {
  const PieceTable made = pieces;
  SurfaceDistance distance;
  double plan_us = 0.0, apply_us = 0.0;
  size_t i = 0;
  for (const auto& [id, volume] : made) {
    const QuantisedPose pose = quantise(poses[i++]);
    const Window exact = exact_union(field, made, {{id, pose}});
    Stopwatch stopwatch;
    const PreparedStamp prepared = prepare_stamp(field, pieces, id, pose, method, volume->mass);
    plan_us += 1000.0 * stopwatch.lap_ms();
    const Applied applied = apply(prepared.operation, field, pieces, &prepared);
    apply_us += 1000.0 * stopwatch.lap_ms();
    add_error(figures, applied.terrain_gain, volume->mass);
    add_distances(gather(field, exact.box), exact, distance);
  }
  figures.plan_us.push_back(plan_us / static_cast<double>(made.size()));
  figures.apply_us.push_back(apply_us / static_cast<double>(made.size()));
  figures.rms_voxels = std::max(figures.rms_voxels, distance.rms());
}

/// A heap: the pieces where they were cut, from the ground up. One operation each, or one for each group.
void merge_heap(bool grouped, Field& field, PieceTable pieces, MethodFigures& figures) {
  const PieceTable made = pieces;
  std::vector<StampedPiece> places;
  for (const auto& [id, volume] : made)
    places.push_back(
        {id, quantise({volume->centre_voxels * voxel_size_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)})});
  std::ranges::stable_sort(places, {}, [](const StampedPiece& one) { return one.pose.y; });
  std::vector<std::vector<StampedPiece>> groups;
  Stopwatch stopwatch;
  if (grouped)
    groups = stamp_groups(places, made, voxel_size_m);
  else
    for (const StampedPiece& one : places) groups.push_back({one});
  double plan_us = 1000.0 * stopwatch.lap_ms(), apply_us = 0.0;
  SurfaceDistance distance;
  for (const std::vector<StampedPiece>& group : groups) {
    MassUnits mass = 0;
    for (const StampedPiece& one : group) mass += made.at(one.piece)->mass;
    const Window exact = exact_union(field, made, group);
    stopwatch.lap_ms();
    const PreparedStamp prepared = prepare_group(field, pieces, group, StampMethod::stamp, mass);
    plan_us += 1000.0 * stopwatch.lap_ms();
    const Applied applied = apply(prepared.operation, field, pieces, &prepared);
    apply_us += 1000.0 * stopwatch.lap_ms();
    add_error(figures, applied.terrain_gain, mass);
    add_distances(gather(field, exact.box), exact, distance);
  }
  figures.plan_us.push_back(plan_us / static_cast<double>(made.size()));
  figures.apply_us.push_back(apply_us / static_cast<double>(made.size()));
  figures.rms_voxels = std::max(figures.rms_voxels, distance.rms());
}

/// The carved terrain, already generated wherever pieces will come to rest, so that generation is not timed.
std::unique_ptr<Field> carved_field(uint32_t random_seed, PieceTable& pieces, Applied& carved) {
  auto field = std::make_unique<MapField>(source);
  carved = apply(carve_operation(random_seed), *field, pieces);
  for (const Pose& pose : resting_places(*field, pieces, radius_m, random_seed))
    gather(*field, band_box(in_voxels(sphere(pose.position_m, 1.5F * radius_m), voxel_size_m)));
  return field;
}

double stock_merge_ms(const Applied& carved, const std::vector<Pose>& poses) {
  MapField pristine(source);
  peers::StockTerrain stock(pristine, {{-128, -64, -128}, {128, 64, 128}});
  std::vector<glm::vec3> seeds_m;
  for (const glm::vec3& seed : carved.seeds_voxels) seeds_m.push_back(seed * voxel_size_m);
  stock.carve(carve_centre(), radius_m, seeds_m);
  return stock.merge(poses).total_ms();
}

void report_figures(BenchReport& report, const std::string& name, const MethodFigures& figures,
                    double stock_us) {
  report.metric(name + "_plan_us", quantile(figures.plan_us, 0.5));
  report.metric(name + "_apply_us", quantile(figures.apply_us, 0.5));
  report.metric(name + "_us_a_piece", figures.piece_us());
  report.metric(name + "_times_faster", stock_us / figures.piece_us());
  report.metric(name + "_mass_error_mean_percent",
                figures.error_sum_percent / static_cast<double>(figures.pieces));
  report.metric(name + "_mass_error_worst_percent", figures.error_worst_percent);
  report.metric(name + "_surface_rms_voxels", figures.rms_voxels);
}

}  // namespace

BenchReport run_recombine_bench(const BenchOptions& options) {
  constexpr auto methods = all_kinds<StampMethod>;
  const int rounds = options.quick ? 2 : 10;
  constexpr std::array<const char*, 2> heap_names = {"heap_one_by_one", "heap_grouped"};
  std::array<MethodFigures, methods.size()> figures;
  std::array<MethodFigures, heap_names.size()> heaps;
  std::vector<double> stock_us;
  for (int round = 0; round < rounds; ++round) {
    const auto random_seed = static_cast<uint32_t>(round) + 1;
    Applied carved;
    std::vector<Pose> poses;
    for (size_t i = 0; i < methods.size(); ++i) {
      PieceTable pieces;
      const auto field = carved_field(random_seed, pieces, carved);
      poses = resting_places(*field, pieces, radius_m, random_seed);
      merge_all(methods[i], *field, pieces, poses, figures[i]);
    }
    for (size_t i = 0; i < heap_names.size(); ++i) {
      PieceTable pieces;
      const auto field = carved_field(random_seed, pieces, carved);
      merge_heap(i == 1, *field, pieces, heaps[i]);
    }
    stock_us.push_back(1000.0 * stock_merge_ms(carved, poses) / static_cast<double>(poses.size()));
    options.progress(static_cast<double>(round + 1) / rounds);
  }
  BenchReport report;
  const double stock = quantile(stock_us, 0.5);
  report.metric("openvdb_us_a_piece", stock);
  for (size_t i = 0; i < methods.size(); ++i)
    report_figures(report, std::string(name_of(methods[i])), figures[i], stock);
  for (size_t i = 0; i < heap_names.size(); ++i) {
    report_figures(report, heap_names[i], heaps[i], stock);
    report.metric(std::string(heap_names[i]) + "_operations",
                  static_cast<double>(heaps[i].pieces) / static_cast<double>(rounds));
  }
  const MethodFigures& stamped = figures[0];
  report.check("times_faster", stock >= 100.0 * stamped.piece_us(),
               fmt::format("{:.0f} µs a piece against {:.0f}: {:.0f} times, wanted 100", stamped.piece_us(),
                           stock, stock / stamped.piece_us()));
  report.check(
      "mass_error", stamped.error_worst_percent <= 0.1,
      fmt::format("{:.3f} % of a piece at worst, wanted at most 0.1 %", stamped.error_worst_percent));
  report.check("surface", stamped.rms_voxels <= 0.1,
               fmt::format("{:.3f} voxel RMS off the exact union, wanted at most 0.1", stamped.rms_voxels));
  return report;
}

}  // namespace scree
