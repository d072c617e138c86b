// Stamping the pieces of a carve back into terrain elsewhere: time, mass and shape, beside OpenVDB's stock
// way and the sphere that the paper's program put in place of a fragment.
#include <cmath>
#include <fmt/format.h>

#include "bench/benches.h"
#include "bench/peers_stock.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "shared/field/edit.h"
#include "shared/field/operation.h"
#include "shared/field/posed_piece.h"
#include "shared/field/stamp.h"

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

/// Whether the posed piece reaches into the terrain.
bool touches(Field& field, const Volume& volume, const Pose& pose) {
  const VoxelBox box = posed_bounds(volume, quantise(pose), voxel_size_m);
  const Window terrain = gather(field, box);
  const Window piece = posed_codes(volume, quantise(pose), voxel_size_m, box);
  for (size_t i = 0; i < terrain.codes.size(); ++i)
    if (terrain.codes[i] < 0 && piece.codes[i] < 0) return true;
  return false;
}

/// On the ground around the crater, turned anyhow: as pieces come to rest. One a piece, none over another.
std::vector<Pose> resting_places(Field& field, const PieceTable& pieces, uint64_t random_seed) {
  constexpr float step_m = 0.02F, apart_m = 4.0F;
  Random random(random_seed);
  std::vector<Pose> poses;
  for (const auto& [id, volume] : pieces) {
    const auto place = static_cast<float>(poses.size());
    const float row = std::floor(place / 8.0F);
    const float x = (place - row * 8.0F - 3.5F) * apart_m + random.unit(), z = (row - 3.5F) * apart_m + 12.0F;
    const float w = random.unit() - 0.5F, i = random.unit() - 0.5F, j = random.unit() - 0.5F,
                k = random.unit() - 0.5F;
    Pose pose{{x, ground_height_m(source, x, z) + radius_m, z}, glm::normalize(glm::quat(w, i, j, k))};
    while (!touches(field, *volume, pose)) pose.position_m.y -= step_m;
    poses.push_back(pose);
  }
  return poses;
}

/// How far a field's surface lies from another's, as squares in voxels².
struct Distance {
  double squares = 0.0;
  double samples = 0.0;
  double rms() const { return std::sqrt(squares / std::max(samples, 1.0)); }
};

/// Where lattice edges cross the surface of `merged`, what distance `exact` gives there.
void add_distances(const Window& merged, const Window& exact, Distance& distance) {
  const VoxelCoord steps[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const VoxelBox inner = merged.box.grown(-1);
  for (int x = inner.lo.x; x < inner.hi.x; ++x)
    for (int y = inner.lo.y; y < inner.hi.y; ++y)
      for (int z = inner.lo.z; z < inner.hi.z; ++z)
        for (const VoxelCoord& step : steps) {
          const double a = merged.at(x, y, z), b = merged.at(x + step.x, y + step.y, z + step.z);
          if ((a < 0.0) == (b < 0.0)) continue;
          const double part = a / (a - b);
          const double here = decode(exact.at(x, y, z)),
                       there = decode(exact.at(x + step.x, y + step.y, z + step.z));
          const double off = here + (there - here) * part;
          distance.squares += off * off;
          distance.samples += 1.0;
        }
}

struct MergeFigures {
  double plan_us = 0.0;  ///< a piece: gather, and find the shift
  double apply_us = 0.0;
  double worst_error_percent = 0.0;
  double mean_error_percent = 0.0;
  Distance distance;
};

void add_error(MergeFigures& figures, MassUnits gain, MassUnits mass, size_t pieces) {
  const double error = 100.0 * std::abs(static_cast<double>(gain - mass)) / static_cast<double>(mass);
  figures.worst_error_percent = std::max(figures.worst_error_percent, error);
  figures.mean_error_percent += error / static_cast<double>(pieces);
}

/// The union of terrain and piece, as exactly as their codes tell it.
Window exact_union(Field& field, const Volume& volume, const QuantisedPose& pose) {
  Window window = gather(field, stamp_box(volume, pose, voxel_size_m));
  const Window piece = posed_codes(volume, pose, voxel_size_m, window.box);
  for (size_t i = 0; i < window.codes.size(); ++i)
    window.codes[i] = std::min(window.codes[i], piece.codes[i]);
  return window;
}

MergeFigures stamp_all(Field& field, PieceTable pieces, const std::vector<Pose>& poses) {
  MergeFigures figures;
  const PieceTable made = pieces;
  size_t i = 0;
  for (const auto& [id, volume] : made) {
    const QuantisedPose pose = quantise(poses[i++]);
    const Window exact = exact_union(field, *volume, pose);
    Stopwatch watch;
    const Window window = gather(field, stamp_box(*volume, pose, voxel_size_m));
    const StampPlan plan = plan_stamp(window, *volume, pose, voxel_size_m, volume->mass);
    figures.plan_us += 1000.0 * watch.lap_ms() / static_cast<double>(made.size());
    const Applied applied = apply(StampOperation{id, pose, plan.shift}, field, pieces);
    figures.apply_us += 1000.0 * watch.lap_ms() / static_cast<double>(made.size());
    add_error(figures, applied.terrain_gain, volume->mass, made.size());
    add_distances(gather(field, exact.box), exact, figures.distance);
  }
  return figures;
}

/// The paper's program: a ball of the fragment's volume where its centre of mass came to rest.
MergeFigures fill_spheres(Field& field, const PieceTable& pieces, const std::vector<Pose>& poses) {
  MergeFigures figures;
  PieceTable none;
  size_t i = 0;
  for (const auto& [id, volume] : pieces) {
    const Pose pose = dequantise(quantise(poses[i++]));
    const Window exact = exact_union(field, *volume, quantise(pose));
    const float voxels = static_cast<float>(volume->mass) / units_per_voxel;
    const Shape ball = sphere(pose.position_m, voxel_size_m * std::cbrt(voxels * 0.23873241F));
    Stopwatch watch;
    const Applied applied = apply(FillOperation{ball}, field, none);
    figures.apply_us += 1000.0 * watch.lap_ms() / static_cast<double>(pieces.size());
    add_error(figures, applied.terrain_gain, volume->mass, pieces.size());
    add_distances(gather(field, exact.box), exact, figures.distance);
  }
  return figures;
}

void report_figures(BenchReport& report, const std::string& name, const MergeFigures& figures) {
  report.metric(name + "_us_a_piece", figures.plan_us + figures.apply_us);
  report.metric(name + "_mass_error_worst_percent", figures.worst_error_percent);
  report.metric(name + "_mass_error_mean_percent", figures.mean_error_percent);
  report.metric(name + "_surface_rms_voxels", figures.distance.rms());
}

}  // namespace

BenchReport run_recombine_bench(const BenchOptions& options) {
  const int rounds = options.quick ? 2 : 10;
  std::vector<double> own_ms, stock_ms, plan_us, apply_us;
  MergeFigures stamped, spheres;
  for (int round = 0; round < rounds; ++round) {
    const auto random_seed = static_cast<uint32_t>(round) + 1;
    MapField field(source), other(source);
    PieceTable pieces, unused;
    const Applied carved = apply(carve_operation(random_seed), field, pieces);
    apply(carve_operation(random_seed), other, unused);
    const std::vector<Pose> poses = resting_places(field, pieces, random_seed);
    for (const Pose& pose : poses) {  // terrain is generated at its first touch: not what is timed
      gather(field, band_box(in_voxels(sphere(pose.position_m, radius_m), voxel_size_m)));
      gather(other, band_box(in_voxels(sphere(pose.position_m, radius_m), voxel_size_m)));
    }
    const MergeFigures stamps = stamp_all(field, pieces, poses);
    const auto count = static_cast<double>(pieces.size());
    own_ms.push_back((stamps.plan_us + stamps.apply_us) * count / 1000.0);
    plan_us.push_back(stamps.plan_us);
    apply_us.push_back(stamps.apply_us);
    stamped = stamps.distance.rms() >= stamped.distance.rms() ? stamps : stamped;
    spheres = fill_spheres(other, pieces, poses);

    MapField pristine(source);
    peers::StockTerrain stock(pristine, {{-128, -64, -128}, {128, 64, 128}});
    std::vector<glm::vec3> seeds_m;
    for (const glm::vec3& seed : carved.seeds_voxels) seeds_m.push_back(seed * voxel_size_m);
    stock.carve(carve_centre(), radius_m, seeds_m);
    stock_ms.push_back(stock.merge(poses).total_ms());
    options.progress(static_cast<double>(round + 1) / rounds);
  }
  BenchReport report;
  report.metric("stamp_plan_us", quantile(plan_us, 0.5));
  report.metric("stamp_apply_us", quantile(apply_us, 0.5));
  report_figures(report, "stamp", stamped);
  report_figures(report, "sphere", spheres);
  const double own = quantile(own_ms, 0.5), stock = quantile(stock_ms, 0.5);
  report.metric("stamp_64_ms", own);
  report.metric("openvdb_64_ms", stock);
  report.check("times_faster", stock >= 100.0 * own,
               fmt::format("{:.2f} ms against {:.1f}: {:.0f} times, wanted 100", own, stock, stock / own));
  report.check(
      "mass_error", stamped.worst_error_percent <= 0.1,
      fmt::format("{:.3f} % of a piece at worst, wanted at most 0.1 %", stamped.worst_error_percent));
  report.check(
      "surface", stamped.distance.rms() <= 0.1,
      fmt::format("{:.3f} voxel RMS off the exact union, wanted at most 0.1", stamped.distance.rms()));
  return report;
}

}  // namespace scree
