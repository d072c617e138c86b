// Voronoi cells alone: ours and voro++'s.
#include <cmath>
#include <fmt/format.h>

#include "bench/peers/voro_cells.h"
#include "shared/base/quantile.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "shared/fracture/voronoi_cells.h"
#include "studies/peers/beside.h"

namespace scree {

namespace {

constexpr float half_side = 8.0F;  ///< voxels: around a ball of 2 m

std::vector<glm::vec3> seeds_in_box(size_t count) {
  Random random(count);
  const auto coordinate = [&] { return (random.unit() * 2.0F - 1.0F) * half_side * 0.99F; };
  std::vector<glm::vec3> seeds;
  for (size_t i = 0; i < count; ++i) {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    seeds.emplace_back(x, y, z);
  }
  return seeds;
}

struct Timed {
  std::vector<double> ours_us, theirs_us;
  double ours_volume = 0.0, theirs_volume = 0.0;
};

Timed time_cells(const std::vector<glm::vec3>& seeds, int rounds) {
  PolygonBounds bounds;
  bounds.lo = glm::dvec3(-half_side);
  bounds.hi = glm::dvec3(half_side);
  Timed timed;
  std::vector<PolygonMesh> ours;
  std::vector<peers::VoroCell> theirs;
  const auto time_ours = [&] {
    const double begin_s = thread_cpu_s();
    ours = voronoi_cells(seeds, bounds);
    timed.ours_us.push_back((thread_cpu_s() - begin_s) * 1e6);
  };
  const auto time_theirs = [&] {
    const double begin_s = thread_cpu_s();
    theirs = peers::voro_cells(glm::vec3(-half_side), glm::vec3(half_side), seeds);
    timed.theirs_us.push_back((thread_cpu_s() - begin_s) * 1e6);
  };
  for (int i = 0; i < rounds; ++i) {
    ours.clear();
    theirs.clear();
    // They take turns: the first finds caches and memory as the round before left them.
    if (i % 2 == 0) time_ours();
    time_theirs();
    if (i % 2 != 0) time_ours();
  }
  for (const PolygonMesh& cell : ours) timed.ours_volume += moments_of(cell).volume;
  for (const peers::VoroCell& cell : theirs) timed.theirs_volume += peers::volume_of(cell);
  return timed;
}

}  // namespace

PeerFindings beside_voronoi(const PeerOptions& options) {
  PeerFindings findings;
  findings.peer = "voro++ 0.4.6";
  findings.name = "voro";
  const int rounds = options.quick ? 20 : 300;
  findings.conditions = {fmt::format(
      "Seeds at random in a cube; every cell as corners and faces, in double precision, on one thread, its "
      "processor time; medians of {} times, in which either comes first by turns. voro++'s time includes "
      "its container and taking corners and faces out; volumes are nobody's. These cells are for the cutters "
      "that work on polygons: Scree's usual one cuts fields without any.",
      rounds)};
  const double whole = std::pow(2.0 * half_side, 3.0);
  for (int run = 0; run < options.runs; ++run) {
    for (const size_t count : {size_t{32}, size_t{128}}) {
      const Timed timed = time_cells(seeds_in_box(count), rounds);
      Comparison& figure = findings.figure(fmt::format("cells_{}_us", count),
                                           fmt::format("{} Voronoi cells, µs", count), 15.0);
      if (count == 128) figure.label = "cells";
      figure.ours.push_back(quantile(timed.ours_us, 0.5));
      figure.theirs.push_back(quantile(timed.theirs_us, 0.5));
      const double ours = std::abs(timed.ours_volume / whole - 1.0),
                   theirs = std::abs(timed.theirs_volume / whole - 1.0);
      findings.check(fmt::format("volume_of_{}", count), ours < 1e-3 && theirs < 1e-3,
                     fmt::format("cells fill the cube to {:.1e} here, to {:.1e} there", ours, theirs));
    }
    options.progress(static_cast<double>(run + 1) / options.runs);
  }
  return findings;
}

}  // namespace scree
