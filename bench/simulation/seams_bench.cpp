// The change of the field when a ball is carved and its pieces are merged back in place, again and again.
// Beside it the same with plain min and max, as constructive solid geometry on sampled fields does it.
#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "shared/operation/operation.h"
#include "shared/recombine/posed_piece.h"
#include "shared/recombine/stamp.h"

namespace scree {

namespace {

constexpr float voxel_size_m = 0.25F;
constexpr float radius_m = 2.0F;
constexpr uint32_t seeds = 64;

/// The voxels that are looked at: the ball's, and some around them.
VoxelBox looked_at(glm::vec3 centre_m) {
  return band_box(in_voxels(sphere(centre_m, radius_m), voxel_size_m)).grown(4);
}

/// A seam is an inside voxel that claims to lie within half a voxel of the surface, but has no neighbour
/// outside. A cavity is an outside voxel where rock was two voxels deep at the start.
struct Wear {
  int seams = 0;
  int cavities = 0;
  double rms_voxels = 0.0;  ///< of the distances, where the surface was at the start
};

bool is_seam(const Window& now, int x, int y, int z) {
  constexpr Code near = -21;
  const Code here = now.at(x, y, z);
  return here < 0 && here > near && now.at(x - 1, y, z) < 0 && now.at(x + 1, y, z) < 0 &&
         now.at(x, y - 1, z) < 0 && now.at(x, y + 1, z) < 0 && now.at(x, y, z - 1) < 0 &&
         now.at(x, y, z + 1) < 0;
}

Wear wear_of(const Window& start, const Window& now) {
  constexpr Code deep = -85, at_surface = 21;
  Wear wear;
  double squares = 0.0;
  int samples = 0;
  const VoxelBox inner = start.box.grown(-1);
  for (int x = inner.lo.x; x < inner.hi.x; ++x)
    for (int y = inner.lo.y; y < inner.hi.y; ++y)
      for (int z = inner.lo.z; z < inner.hi.z; ++z) {
        const Code then = start.at(x, y, z);
        wear.seams += is_seam(now, x, y, z) ? 1 : 0;
        wear.cavities += then <= deep && now.at(x, y, z) >= 0 ? 1 : 0;
        if (std::abs(then) > at_surface) continue;
        const double off = decode(now.at(x, y, z)) - decode(then);
        squares += off * off;
        ++samples;
      }
  wear.rms_voxels = std::sqrt(squares / std::max(samples, 1));
  return wear;
}

/// Puts a piece back as plain union of two sampled fields.
void unite_plainly(Field& field, PieceTable& pieces, PieceId id, const QuantisedPose& pose) {
  const std::shared_ptr<const Volume> volume = pieces.at(id);
  const VoxelBox box = stamp_box(*volume, pose, voxel_size_m);
  Window window = gather(field, box);
  const Window piece = posed_codes(*volume, pose, voxel_size_m, box);
  for (size_t i = 0; i < window.codes.size(); ++i)
    window.codes[i] = std::min(window.codes[i], piece.codes[i]);
  scatter(field, window);
  pieces.erase(id);
}

struct Cycles {
  Window start;
  Window end;
  MassUnits moved = 0;  ///< by all carves
};

/// One history of carves: its seeds decide all of it.
struct History {
  TerrainKind kind = TerrainKind::flat;
  int cycles = 0;
  uint32_t random_seed = 0;
};

template <typename Merge>
Cycles run_cycles(const History& history, Merge&& merge) {
  MapField field({history.kind, 1, voxel_size_m});
  PieceTable pieces;
  const glm::vec3 centre(0.0F, ground_height_m(field.source(), 0.0F, 0.0F) - 0.6F, 0.0F);
  Cycles result;
  result.start = gather(field, looked_at(centre));
  PieceId next = 1;
  for (int i = 0; i < history.cycles; ++i) {
    const Applied carved = apply(CarveOperation{sphere(centre, radius_m), SeedPattern::uniform, seeds,
                                                history.random_seed + static_cast<uint32_t>(i), centre, next},
                                 field, pieces);
    result.moved -= carved.terrain_gain;
    for (const CreatedPiece& piece : carved.created) {
      next = piece.id + 1;
      merge(field, pieces, piece.id, quantise({pieces.at(piece.id)->centre_voxels * voxel_size_m}));
    }
  }
  result.end = gather(field, looked_at(centre));
  return result;
}

Cycles stamp_cycles(const History& history) {
  MassUnits dust = 0;
  return run_cycles(history, [&](Field& field, PieceTable& pieces, PieceId id, QuantisedPose pose) {
    const std::shared_ptr<const Volume> volume = pieces.at(id);
    const Window window = gather(field, stamp_box(*volume, pose, voxel_size_m));
    const StampPlan plan =
        plan_stamp(laying_rounded, window, *volume, pose, voxel_size_m, stamp_budget(volume->mass, dust));
    dust += volume->mass - apply(StampOperation{id, pose, plan.shift}, field, pieces).terrain_gain;
  });
}

/// The results after several histories: the worst of each figure.
struct Figures {
  double lost_percent = 0.0;
  double lost_voxels = 0.0;
  int seams_before = 0;
  int seams_after = 0;
  int cavities = 0;
  double rms_voxels = 0.0;
  double rms_mean_voxels = 0.0;
};

double larger(double a, double b) {
  return std::abs(a) >= std::abs(b) ? a : b;
}

template <typename Run>
Figures worst_of(int histories, History history, Run&& run) {
  constexpr uint32_t apart = 1000;  // seeds between one history and the next
  Figures worst;
  for (int i = 0; i < histories; ++i) {
    history.random_seed = static_cast<uint32_t>(i) * apart + 1;
    const Cycles cycles = run(history);
    const Wear before = wear_of(cycles.start, cycles.start), after = wear_of(cycles.start, cycles.end);
    const auto lost = static_cast<double>(mass_of(cycles.start) - mass_of(cycles.end));
    worst.lost_percent = larger(100.0 * lost / static_cast<double>(cycles.moved), worst.lost_percent);
    worst.lost_voxels = larger(lost / units_per_voxel, worst.lost_voxels);
    worst.seams_before = before.seams;
    worst.seams_after = std::max(worst.seams_after, after.seams);
    worst.cavities = std::max(worst.cavities, after.cavities);
    worst.rms_voxels = std::max(worst.rms_voxels, after.rms_voxels);
    worst.rms_mean_voxels += after.rms_voxels / histories;
  }
  return worst;
}

void report_figures(BenchReport& report, const std::string& name, const Figures& figures) {
  report.metric(name + "_volume_lost_percent", figures.lost_percent);
  report.metric(name + "_lost_voxels", figures.lost_voxels);
  report.metric(name + "_seam_voxels_before", figures.seams_before);
  report.metric(name + "_seam_voxels_after", figures.seams_after);
  report.metric(name + "_cavity_voxels", figures.cavities);
  report.metric(name + "_surface_rms_voxels", figures.rms_voxels);
  report.metric(name + "_surface_rms_mean_voxels", figures.rms_mean_voxels);
}

void check_figures(BenchReport& report, const std::string& name, const Figures& figures) {
  report.check(
      name + "_volume", std::abs(figures.lost_percent) <= 0.1,
      fmt::format("{:.4f} % of the volume moved is gone, wanted at most 0.1 %", figures.lost_percent));
  report.check(name + "_seams", figures.seams_after <= figures.seams_before,
               fmt::format("{} near-zero voxels inside, wanted no more than the {} at the start",
                           figures.seams_after, figures.seams_before));
  report.check(name + "_surface", figures.rms_voxels <= 0.12,
               fmt::format("{:.3f} voxel RMS off the start, wanted at most 0.12", figures.rms_voxels));
}

}  // namespace

BenchReport run_seams_bench(const BenchOptions& options) {
  const int cycles = options.quick ? 5 : 50;
  // The results of histories differ much: the worst of several counts.
  const int histories = options.quick ? 1 : 5;
  BenchReport report;
  report.metric("cycles", cycles);
  report.metric("histories", histories);
  double done = 0.0;
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::noise}) {
    const std::string name(name_of(kind));
    const Figures stamped = worst_of(histories, {kind, cycles, 0}, stamp_cycles);
    report_figures(report, name, stamped);
    check_figures(report, name, stamped);
    options.progress(done += 0.25);
    report_figures(report, name + "_plain_min_max", worst_of(1, {kind, cycles, 0}, [](const History& h) {
                     return run_cycles(h, unite_plainly);
                   }));
    options.progress(done += 0.25);
  }
  return report;
}

}  // namespace scree
