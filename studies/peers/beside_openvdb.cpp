// OpenVDB's stock tools. The benches that measure Scree beside them are run as they are.
#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "bench/peers/level_set_fracture.h"
#include "bench/support/benches.h"
#include "shared/base/quantile.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"
#include "studies/peers/beside.h"

namespace scree {

namespace {

constexpr float voxel_m = 0.25F;

/// A figure of a bench, which has the peer's beside it.
struct BenchFigure {
  const char* ours;
  const char* theirs;
  const char* what;
  double noise_percent;
  const char* label = "";
  bool more_is_better = false;
};

/// A bench, by its name in all_benches().
struct PeerBench {
  const char* name;
  std::vector<BenchFigure> figures;
};

const std::vector<PeerBench>& peer_benches() {
  static const std::vector<PeerBench> table = {
      {"carve",
       {{"own_work_median_ms", "openvdb_median_ms",
         "a carve of 2 m into 64 pieces with hulls, ms: csgDifference, meshToVolume, csgIntersectionCopy, "
         "volumeToMesh",
         30.0, "carve"},
        {"crater_own_work_median_ms", "openvdb_median_ms",
         "the same by a rough crater (OpenVDB: a smooth ball), ms", 30.0}}},
      {"recombine",
       {{"facets_us_a_piece", "openvdb_us_a_piece",
         "a piece becomes terrain (facets), µs: meshToVolume, csgUnion", 30.0, "merge"},
        {"stamp_us_a_piece", "openvdb_us_a_piece", "the same by stamp, µs", 30.0}}},
      {"islands",
       {{"64_m_tower_find_median_ms", "peer_segment_sdf_median_ms",
         "what a cut of a tower's foot loosened in 64 m of terrain, ms: segmentSDF", 20.0, "islands"}}},
      {"mesh",
       {{"million_quads_per_s", "openvdb_million_quads_per_s",
         "meshing 64 m of carved terrain on one thread, million quads a second: volumeToMesh", 20.0,
         "meshing", true},
        {"with_gathering_million_quads_per_s", "openvdb_million_quads_per_s",
         "the same, with copying out of the field", 20.0, "", true}}}};
  return table;
}

std::optional<double> value_of(const BenchReport& report, const std::string& metric) {
  const auto found = std::ranges::find(report.metrics, metric, &Metric::name);
  return found == report.metrics.end() ? std::nullopt : std::optional(found->value);
}

/// The figures that the bench measured and all its checks; one that it lacks is told as missing.
void add_finding(const PeerBench& wanted, const BenchReport& report, PeerFindings& findings) {
  for (const BenchFigure& each : wanted.figures) {
    const std::optional<double> ours = value_of(report, each.ours), theirs = value_of(report, each.theirs);
    if (!ours || !theirs) {
      findings.missing = fmt::format("the bench {} tells no {}", wanted.name, ours ? each.theirs : each.ours);
      continue;
    }
    Comparison& figure = findings.figure(fmt::format("{}_{}", wanted.name, each.ours), each.what,
                                         each.noise_percent, each.more_is_better);
    figure.label = each.label;
    figure.ours.push_back(*ours);
    figure.theirs.push_back(*theirs);
  }
  for (const Check& each : report.checks)
    findings.check(fmt::format("{}_{}", wanted.name, each.name), each.passed, each.detail);
}

void run_bench(const PeerBench& wanted, bool quick, const std::function<void(double)>& progress,
               PeerFindings& findings) {
  const auto bench = std::ranges::find(all_benches(), std::string(wanted.name), &Bench::name);
  if (bench == all_benches().end()) {
    findings.missing = fmt::format("there is no bench {}", wanted.name);
    return;
  }
  BenchOptions options;
  options.quick = quick;
  options.progress = progress;
  add_finding(wanted, bench->run(options), findings);
}

/// A ball carved out of solid rock into so many pieces, and where its seeds were, from its centre.
struct BrokenBall {
  std::vector<glm::vec3> places_m;
  size_t pieces = 0;
};

std::pair<BrokenBall, double> break_ball(float radius_m, uint32_t seeds) {
  const TerrainSource terrain{TerrainKind::flat, 1, voxel_m};
  const glm::vec3 centre_m(0.0F, -8.0F, 0.0F);
  const Shape shape = sphere(centre_m, radius_m);
  MapField field(terrain);
  PieceTable pieces;
  gather(field, band_box(in_voxels(shape, voxel_m)).grown(chunk_size));
  Stopwatch stopwatch;
  const Applied applied =
      apply(CarveOperation{shape, SeedPattern::uniform, seeds, 5, centre_m, 1}, field, pieces);
  const double own_ms = stopwatch.lap_ms();
  BrokenBall ball{{}, applied.created.size()};
  for (const glm::vec3& seed : applied.seeds_voxels) ball.places_m.push_back(seed * voxel_m - centre_m);
  return {ball, own_ms};
}

}  // namespace

PeerFindings beside_openvdb(const PeerOptions& options) {
  PeerFindings findings;
  findings.peer = "OpenVDB 10.0.1, stock tools";
  findings.name = "openvdb";
  findings.conditions = {
      "Grids of floats, with the field's own distances in 0.25 m voxels; OpenVDB uses every core, Scree's "
      "kernels one. Times are the clock's. These are the benches `carve`, `recombine`, `islands` and "
      "`mesh`, which say in detail what they do; their checks are among those below.",
      "A carve takes a ball of 2 m out of hills and breaks it into 64 Voronoi cells. Scree's median is of "
      "blows one after another in one world, which fills with craters; OpenVDB's is of the first few of the "
      "same blows, each in 64 m of fresh hills and by the seeds that Scree has there. The check "
      "`carve_times_faster` says how many blows each has. Scree's time has the carve, the cells, the "
      "pieces' fields and masses, and convex hulls with bodies; OpenVDB's has pieces and their meshes, by "
      "voro++'s cells.",
      "A merge puts a piece into the terrain where it came to rest. Scree's conserves mass and keeps "
      "distances true; OpenVDB's is the plain union.",
      "`segmentSDF` walks the whole grid; Scree floods around what was cut."};
  const std::vector<PeerBench>& benches = peer_benches();
  for (int run = 0; run < options.runs; ++run)
    for (size_t i = 0; i < benches.size(); ++i) {
      const auto progress = [&](double part) {
        const double done = (static_cast<double>(i) + part) / static_cast<double>(benches.size());
        options.progress((run + done) / options.runs);
      };
      run_bench(benches[i], options.quick, progress, findings);
    }
  return findings;
}

PeerFindings beside_level_set_fracture(const PeerOptions& options) {
  constexpr float radius_m = 2.0F, side_m = 1.2F;
  const uint32_t cutters = options.quick ? 4 : 16;
  const int tries = options.quick ? 1 : 5;
  PeerFindings findings;
  findings.peer = "OpenVDB 10.0.1, LevelSetFracture";
  findings.name = "level_set_fracture";
  findings.conditions = {fmt::format(
      "A ball of {:.0f} m in voxels of 0.25 m. OpenVDB's own fracture tool breaks it by {} turned cubes of "
      "{:.1f} m, connected parts apart; Scree carves it out of solid rock into {} Voronoi cells about the "
      "same points. The shapes of the pieces differ. Times are medians of {} tries, by the clock; OpenVDB "
      "uses every core.",
      radius_m, cutters, side_m, cutters, tries)};
  for (int run = 0; run < options.runs; ++run) {
    std::vector<double> ours_ms, theirs_ms;
    for (int i = 0; i < tries; ++i) {
      const auto [ball, own_ms] = break_ball(radius_m, cutters);
      const peers::LevelSetPieces theirs = peers::fracture_ball(radius_m, voxel_m, side_m, ball.places_m);
      ours_ms.push_back(own_ms);
      theirs_ms.push_back(theirs.milliseconds);
      findings.check("breaks", ball.pieces > 1 && theirs.pieces > 1,
                     fmt::format("{} pieces here, {} there", ball.pieces, theirs.pieces));
    }
    Comparison& figure =
        findings.figure("ball_ms", fmt::format("a ball of 2 m broken by {} cutters, ms", cutters), 30.0);
    figure.label = "LevelSetFracture";
    figure.ours.push_back(quantile(ours_ms, 0.5));
    figure.theirs.push_back(quantile(theirs_ms, 0.5));
    options.progress(static_cast<double>(run + 1) / options.runs);
  }
  return findings;
}

}  // namespace scree
