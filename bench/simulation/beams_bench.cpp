#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/span_cases.h"
#include "content/builtin_palette.h"

namespace scree {

namespace {

constexpr double share_off = 0.15;

/// Median time of a search at the span at which it nearly breaks, and at half of that, where it stands.
double search_us(const SpanCase& one, double span_m) {
  MapField field(span_ground());
  const glm::vec3 at = one.build(field, static_cast<float>(span_m)) / field.source().voxel_size_m;
  const std::vector<BrickCoord> changed{
      brick_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)})};
  std::vector<double> us;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    find_spans(field, builtin_palette(), changed);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    us.push_back(took.count());
  }
  return quantile(us, 0.5);
}

void compare(const SpanCase& one, BenchReport& report) {
  const double found_m = found_span_m(one);
  const double ratio = found_m / one.theory_m;
  report.metric(one.name + "_span_m", found_m);
  report.metric(one.name + "_span_over_theory", ratio);
  report.metric(one.name + "_stands_us", search_us(one, 0.9 * found_m));
  report.metric(one.name + "_breaks_us", search_us(one, 1.1 * found_m));
  report.check(one.name, std::abs(ratio - 1.0) <= share_off,
               fmt::format("theory {:.2f} m, found {:.2f} m: {:.3f}, within 0.85 … 1.15", one.theory_m,
                           found_m, ratio));
}

/// Searches all over generated ground, where nothing spans anything.
void search_ground(BenchReport& report, float step_m) {
  std::vector<double> ms;
  size_t overloads = 0;
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::canyon, TerrainKind::noise}) {
    const TerrainSource source{kind, 1, 0.25F};
    MapField field(source);
    for (float x = -48.0F; x < 48.0F; x += step_m)
      for (float z = -48.0F; z < 48.0F; z += step_m) {
        const glm::vec3 at = glm::vec3(x, ground_height_m(source, x, z), z) / source.voxel_size_m;
        const std::vector<BrickCoord> changed{
            brick_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)})};
        find_spans(field, builtin_palette(), changed);
        const auto start = std::chrono::steady_clock::now();
        overloads += find_spans(field, builtin_palette(), changed).overloads.size();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        ms.push_back(took.count());
      }
  }
  report.metric("ground_p50_ms", quantile(ms, 0.5));
  report.metric("ground_p99_ms", quantile(ms, 0.99));
  report.metric("ground_breaks", static_cast<double>(overloads));
}

}  // namespace

BenchReport run_beams_bench(const BenchOptions& options) {
  BenchReport report;
  const std::vector<SpanCase> cases = span_cases(options.quick);
  for (const SpanCase& one : cases) {
    compare(one, report);
    options.progress(static_cast<double>(&one - cases.data() + 1) / static_cast<double>(cases.size()));
  }
  for (const float span_m : {20.0F, 26.0F}) {
    const bool arch = search_span(parabolic_arch(6.0F, 1.0F), span_m).overloads.empty();
    const bool flat = search_span(clamped_beam(1.0F, 0.0F), span_m).overloads.empty();
    report.check(fmt::format("arch_of_{:.0f}_m", span_m), arch && !flat,
                 fmt::format("arch {}, flat beam {}", arch ? "stands" : "falls", flat ? "stands" : "falls"));
  }
  search_ground(report, options.quick ? 24.0F : 8.0F);
  return report;
}

}  // namespace scree
