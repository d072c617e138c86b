#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/brute_surface.h"
#include "bench/support/carved_field.h"
#include "shared/base/timing.h"
#include "shared/query/query.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

const TerrainSource query_ground{TerrainKind::noise, 3, 0.25F};
constexpr float carved_half_m = 16.0F;
constexpr int edits = 600;
constexpr double tenth_of_voxel = 0.1;

glm::vec3 some_direction(Random& random) {
  for (;;) {
    const glm::vec3 v(random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F);
    const float squared = glm::dot(v, v);
    if (squared > 0.01F && squared < 1.0F) return glm::vec3(unit_of(glm::dvec3(v)));
  }
}

/// Carved ground, a thousand bodies above it, and places of questions.
struct QueryWorld {
  MapField field{query_ground};
  glm::vec3 middle_m{0.0F};
  std::vector<Convex> parts{convex_box({}, {0.4F, 0.9F, 0.4F}), convex_sphere({0.0F, 1.2F, 0.0F}, 0.3F)};
  std::vector<QuerySolid> solids;

  QueryWorld() {
    middle_m.y = ground_height_m(query_ground, 0.0F, 0.0F);
    roughen(field, middle_m, carved_half_m, edits, 5);
    Random random(2);
    for (PieceId id = 1; id <= 1000; ++id) {
      QuerySolid body;
      body.id = id;
      body.pose.position_m = place(random, 100.0F) + glm::vec3(0.0F, 3.0F, 0.0F);
      body.parts = parts;
      solids.push_back(body);
    }
  }
  /// Eye height over the ground, within a square.
  glm::vec3 place(Random& random, float half_m) const {
    const float x = (random.unit() * 2.0F - 1.0F) * half_m, z = (random.unit() * 2.0F - 1.0F) * half_m;
    return {x, ground_height_m(query_ground, x, z) + 0.5F + random.unit() * 3.0F, z};
  }
};

/// Asks `count` questions twice: what the second time, which reads nothing new, took and cost.
template <typename Ask>
void measure(BenchReport& report, const std::string& name, const QueryWorld& world, const QueryScene& scene,
             int count, Ask&& ask) {
  std::vector<double> us;
  double steps = 0.0, all_us = 0.0;
  for (const bool counts : {false, true}) {
    Random random(17);
    for (int i = 0; i < count; ++i) {
      const glm::vec3 from = world.place(random, carved_half_m), unit = some_direction(random);
      const double start = thread_cpu_s();
      const QueryCost cost = ask(scene, from, unit);
      const double took = (thread_cpu_s() - start) * 1e6;
      if (!counts) continue;
      us.push_back(took);
      all_us += took;
      steps += cost.steps;
    }
  }
  report.metric(name + "_mean_us", all_us / count);
  report.metric(name + "_p99_us", quantile(us, 0.99));
  report.metric(name + "_steps", steps / count);
  report.metric(name + "_step_ns", all_us * 1000.0 / steps);
}

template <typename T>
QueryCost cost_of_answer(const QueryResult<T>& result) {
  return result ? result->cost : QueryCost();
}

void measure_kinds(BenchReport& report, const QueryWorld& world, const BenchOptions& options) {
  const QueryScene scene(world.field, world.solids);
  const int count = options.quick ? 200 : 5000;
  using V = glm::vec3;
  const auto run = [&](const std::string& name, auto&& ask) {
    measure(report, name, world, scene, count, ask);
    options.progress(0.0);
  };
  run("ray_10_m", [](const QueryScene& s, V p, V u) { return cost_of_answer(cast_ray(s, p, u, 10.0F)); });
  run("ray_100_m", [](const QueryScene& s, V p, V u) { return cost_of_answer(cast_ray(s, p, u, 100.0F)); });
  run("ray_100_m_in_air", [](const QueryScene& s, V p, V u) {
    return cost_of_answer(cast_ray(s, p, V(u.x, std::abs(u.y), u.z), 100.0F));
  });
  run("sphere_10_m",
      [](const QueryScene& s, V p, V u) { return cost_of_answer(cast_sphere(s, p, u, 10.0F, 0.4F)); });
  run("capsule_1_m", [](const QueryScene& s, V p, V u) {
    return cost_of_answer(cast_capsule(s, p, p + V(0.0F, 1.0F, 0.0F), u, 1.0F, 0.4F));
  });
  run("overlap_sphere_1_m",
      [](const QueryScene& s, V p, V) { return cost_of_answer(overlap_sphere(s, p, 1.0F)); });
  run("overlap_box_2_m",
      [](const QueryScene& s, V p, V) { return cost_of_answer(overlap_box(s, p - 1.0F, p + 1.0F)); });
  run("nearest_4_m", [](const QueryScene& s, V p, V) { return cost_of_answer(nearest_surface(s, p, 4.0F)); });
  run("is_solid", [](const QueryScene& s, V p, V) { return cost_of_answer(is_solid(s, p)); });
  run("box_content_8_m",
      [](const QueryScene& s, V p, V) { return cost_of_answer(box_content(s, p - 4.0F, p + 4.0F)); });
}

/// What a scene costs: for one question alone, on ground that is there, and on ground that is not.
void measure_scenes(BenchReport& report, const QueryWorld& world, bool quick) {
  const int count = quick ? 20 : 300;
  Random random(23);
  double bare_us = 0.0, solids_us = 0.0, fresh_us = 0.0, chunks = 0.0;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = world.place(random, carved_half_m), unit = some_direction(random);
    Stopwatch watch;
    (void)cast_ray(QueryScene(world.field, {}), from, unit, 10.0F);
    bare_us += watch.lap_ms() * 1000.0;
    const QueryScene scene(world.field, world.solids);
    solids_us += watch.lap_ms() * 1000.0;
    if (i % 10 != 0) continue;
    const MapField fresh(query_ground);
    const QueryScene first(fresh, {});
    watch.lap_ms();
    const auto cast = cast_ray(first, from, unit, 100.0F);
    fresh_us += watch.lap_ms() * 1000.0;
    chunks += cast ? static_cast<double>(cast->cost.chunks) : 0.0;
  }
  report.metric("new_scene_ray_10_m_us", bare_us / count);
  report.metric("new_scene_1000_solids_us", solids_us / count);
  report.metric("ungenerated_ray_100_m_us", fresh_us / (count / 10));
  report.metric("ungenerated_chunk_us", fresh_us / chunks);
}

void check_agreement(BenchReport& report, const QueryWorld& world, const BenchOptions& options) {
  const int casts = options.quick ? 2000 : 100000;
  constexpr float reach_m = 6.0F;
  BruteSurface brute;
  const int y = static_cast<int>(world.middle_m.y / 0.25F);
  brute.add_field(world.field, VoxelBox{{-64, y - 64, -64}, {64, y + 64, 64}}.grown(32));
  const QueryScene scene(world.field, {});
  Random random(29);
  int hits = 0, through = 0, inside = 0, false_hits = 0;
  double worst = 0.0;
  for (int i = 0; i < casts; ++i) {
    const auto part = [&] { return (random.unit() * 2.0F - 1.0F) * carved_half_m; };
    const glm::vec3 from = world.middle_m + glm::vec3(part(), part(), part()), unit = some_direction(random);
    const auto cast = cast_ray(scene, from, unit, reach_m);
    const bool hit = cast && cast->answer.has_value();
    if (hit && cast->answer->inside) {
      ++inside;
      continue;
    }
    const auto reference =
        brute.first_on_line(glm::dvec3(from) * 4.0, unit_of(glm::dvec3(unit)), 4.0 * double(reach_m));
    if (!reference) {
      false_hits += hit ? 1 : 0;
      continue;
    }
    ++hits;
    if (!hit || double(cast->answer->distance_m) * 4.0 > *reference + tenth_of_voxel)
      ++through;
    else
      worst = std::max(worst, std::abs(double(cast->answer->distance_m) * 4.0 - *reference));
    if (i % 1000 == 0) options.progress(double(i) / casts);
  }
  report.metric("agreement_casts", casts);
  report.metric("agreement_hits", hits);
  report.metric("agreement_inside", inside);
  report.metric("agreement_worst_voxels", worst);
  report.check("never_through", through == 0, fmt::format("{} of {} hits", through, hits));
  report.check("no_hit_of_nothing", false_hits == 0, fmt::format("{} of {} casts", false_hits, casts));
  report.check("within_a_tenth_of_a_voxel", worst <= tenth_of_voxel,
               fmt::format("{:.2g} voxels, of {} triangles", worst, brute.triangles()));
}

}  // namespace

BenchReport run_query_bench(const BenchOptions& options) {
  BenchReport report;
  const QueryWorld world;
  measure_kinds(report, world, options);
  measure_scenes(report, world, options.quick);
  check_agreement(report, world, options);
  return report;
}

}  // namespace scree
