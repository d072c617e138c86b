#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "content/builtin_palette.h"
#include "server/world/limits.h"
#include "shared/falling/support_search.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr float voxel_m = 0.25F;
constexpr float gravity_m_s2 = 9.81F;

/// Times of searches, after a first one has generated the terrain.
struct Searches {
  std::vector<double> ms;
  double us = 0.0;
  size_t parts = 0;
};

void search_ground(TerrainSource source, float half_m, float step_m, Searches& searches) {
  MapField field(source);
  for (float x = -half_m; x < half_m; x += step_m)
    for (float z = -half_m; z < half_m; z += step_m) {
      const glm::vec3 at = glm::vec3(x, ground_height_m(source, x, z), z) / source.voxel_size_m;
      const std::vector<BrickCoord> changed{
          brick_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)})};
      find_overloads(field, builtin_palette(), changed, limits::support_reach_bricks);
      const auto start = std::chrono::steady_clock::now();
      const SupportFound found =
          find_overloads(field, builtin_palette(), changed, limits::support_reach_bricks);
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
      searches.ms.push_back(took.count());
      searches.us += took.count() * 1000.0;
      searches.parts += found.parts;
    }
}

/// Whether a beam that sticks out of a wall breaks when its root changes.
bool beam_breaks(Material material, float height_m, float length_m) {
  MapField field({TerrainKind::flat, 1, voxel_m});
  PieceTable none;
  for (const Shape& shape :
       {box({-3.0F, 5.0F, 0.1F}, {2.9F, 8.0F, 6.0F}),
        box({-0.6F + 0.5F * length_m, 7.3F, 0.1F}, {0.5F * length_m + 0.5F, 0.5F * height_m, 1.0F})})
    apply(FillOperation{shape}, field, none);
  for (float x = -6.0F; x < 20.0F; x += 5.0F)
    apply(PaintOperation{box({x, 6.0F, 0.0F}, glm::vec3(8.0F)), material}, field, none);
  const std::vector<BrickCoord> changed{{0, 3, 0}, {-1, 3, 0}};
  return !find_overloads(field, builtin_palette(), changed, limits::support_reach_bricks).overloads.empty();
}

/// The least length at which it breaks, over the length at which the tension at its root is what it bears:
/// √(σ h / (3 ρ g)).
double length_over_formula(Material material, float height_m) {
  const MaterialRow& row = builtin_palette().row(material);
  const float formula_m =
      std::sqrt(row.bearing.bending_pa * height_m / (3.0F * row.density_kg_m3 * gravity_m_s2));
  float holds_m = 0.25F * formula_m, breaks_m = 1.3F * formula_m;
  if (beam_breaks(material, height_m, holds_m) || !beam_breaks(material, height_m, breaks_m)) return 0.0;
  for (int i = 0; i < 8; ++i) {
    const float between_m = 0.5F * (holds_m + breaks_m);
    (beam_breaks(material, height_m, between_m) ? breaks_m : holds_m) = between_m;
  }
  return static_cast<double>(breaks_m / formula_m);
}

}  // namespace

BenchReport run_support_bench(const BenchOptions& options) {
  BenchReport report;
  for (const Material material : {material::rock, material::soil, material::ice})
    for (const float height_m : {1.5F, 2.5F, 4.0F}) {
      const double ratio = length_over_formula(material, height_m);
      const std::string name = fmt::format("beam_{}_{:.0f}_dm_length_over_formula",
                                           builtin_palette().row(material).name, 10.0F * height_m);
      report.metric(name, ratio);
      report.check(name, ratio >= 0.9 && ratio <= 1.1, fmt::format("{:.3f}, within 0.9 … 1.1", ratio));
    }
  options.progress(0.5);
  Searches searches;
  const float step_m = options.quick ? 24.0F : 8.0F;
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::canyon, TerrainKind::noise})
    search_ground({kind, 1, voxel_m}, 48.0F, step_m, searches);
  const double p50 = quantile(searches.ms, 0.5), p99 = quantile(searches.ms, 0.99);
  report.metric("search_p50_ms", p50);
  report.metric("search_p99_ms", p99);
  report.metric("search_us_per_part", searches.us / static_cast<double>(searches.parts));
  report.check("search_p99_ms", p99 <= 2.0, fmt::format("{:.2f}, at most 2", p99));
  return report;
}

}  // namespace scree
