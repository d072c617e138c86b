#include <algorithm>
#include <fmt/format.h>
#include <functional>

#include "bench/support/benches.h"
#include "bench/support/travels.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr int seconds_max = 60;

/// A world, what happened in it so far, and the next request's number.
struct Scene {
  explicit Scene(TerrainColliderKind collider) : world(config(collider)) {}

  static WorldConfig config(TerrainColliderKind collider) {
    WorldConfig config;
    config.terrain = {TerrainKind::flat, 1, 0.25F};
    config.methods.collider = collider;
    return config;
  }

  void step(std::vector<Command> commands = {}) {
    const auto delta = world.step(commands);
    travels.observe(world, *delta);
    alive = delta->pieces.size();
    ledger_error = std::max(ledger_error, std::abs(delta->ledger.error()));
    for (const AppliedOperation& applied : delta->operations)
      lost += std::holds_alternative<DiscardOperation>(applied.operation) ? 1 : 0;
    for (const Reply& reply : delta->replies) refused += reply.refusal.empty() ? 0 : 1;
  }
  void fill(const Shape& shape) { step({{0, 0, FillRequest{shape}}}); }
  void carve(const Shape& shape, glm::vec3 impact_m, uint32_t seeds) {
    CarveRequest request;
    request.shape = shape;
    request.seeds = seeds;
    request.impact_m = impact_m;
    step({{0, 0, request}});
  }

  World world;
  Travels travels;
  size_t alive = 0;
  int lost = 0;
  int refused = 0;
  MassUnits ledger_error = 0;
};

/// A stem and a cap of some size, whose stem is carved away.
void mushroom(Scene& scene, uint64_t random_seed) {
  Random random(random_seed);
  const auto between = [&](float lo, float hi) { return lo + (hi - lo) * random.unit(); };
  const float height_m = between(2.0F, 4.0F), stem_m = between(0.6F, 1.2F);
  const glm::vec3 cap_m{between(2.0F, 4.5F), between(1.0F, 3.0F), between(2.0F, 4.5F)};
  scene.fill(capsule({0.0F, -1.0F, 0.0F}, {0.0F, height_m, 0.0F}, stem_m));
  scene.fill(box({0.0F, height_m + cap_m.y, 0.0F}, cap_m));
  scene.carve(capsule({0.0F, 0.6F, 0.0F}, {0.0F, height_m - 0.3F, 0.0F}, stem_m + 0.4F),
              {stem_m, 0.5F * height_m, 0.0F}, 64);
}

void ball(Scene& scene) {
  scene.fill(capsule({0.0F, -1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}, 0.8F));
  scene.fill(sphere({0.0F, 5.0F, 0.0F}, 3.5F));
  scene.carve(sphere({0.0F, 1.0F, 0.0F}, 1.4F), {0.0F, 1.0F, 1.0F}, 64);
}

void block_on_a_pillar(Scene& scene) {
  scene.fill(box({0.0F, 1.5F, 0.0F}, {1.0F, 1.5F, 1.0F}));
  scene.fill(box({0.0F, 6.0F, 0.0F}, {4.0F, 3.0F, 4.0F}));
  scene.carve(box({0.0F, 1.5F, 0.0F}, {1.5F, 1.4F, 1.5F}), {0.0F, 1.5F, 1.5F}, 64);
}

void pour_over_pieces(Scene& scene) {
  scene.carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 48);
  for (int tick = 0; tick < 20; ++tick) scene.step();
  scene.fill(sphere({0.0F, 0.0F, 0.0F}, 6.0F));
}

struct SingleScene {
  const char* name;
  void (*build)(Scene& scene);
};

constexpr SingleScene single_scenes[] = {
    {"ball", ball}, {"pillar", block_on_a_pillar}, {"pour", pour_over_pieces}};

struct Sums {
  size_t travellers = 0;
  int lost = 0;
  size_t alive = 0;
  MassUnits ledger_error = 0;
  int refused = 0;
};

void play(const std::function<void(Scene&)>& scene_of, TerrainColliderKind collider, Sums& sums) {
  Scene scene(collider);
  scene_of(scene);
  for (int tick = 0; tick < seconds_max * 60 && scene.alive > 0; ++tick) scene.step();
  sums.travellers += scene.travels.travellers();
  sums.lost += scene.lost;
  sums.alive += scene.alive;
  sums.ledger_error = std::max(sums.ledger_error, scene.ledger_error);
  sums.refused += scene.refused;
}

void report_sums(BenchReport& report, const std::string& name, const Sums& sums) {
  report.metric(name + "_travellers", static_cast<double>(sums.travellers));
  report.metric(name + "_out_of_the_world", sums.lost);
  report.metric(name + "_alive_after_60_s", static_cast<double>(sums.alive));
  report.metric(name + "_ledger_error", static_cast<double>(sums.ledger_error));
  const bool none = sums.travellers == 0 && sums.lost == 0 && sums.alive == 0 && sums.ledger_error == 0;
  report.check(name, none && sums.refused == 0,
               fmt::format("{} travelled, {} lost, {} alive, ledger error {}, {} refused; wanted none",
                           sums.travellers, sums.lost, sums.alive, sums.ledger_error, sums.refused));
}

}  // namespace

BenchReport run_buried_bench(const BenchOptions& options) {
  BenchReport report;
  const uint64_t mushrooms = options.quick ? 2 : 8;
  double done = 0.0;
  const double all = 4.0 * static_cast<double>(kind_count<TerrainColliderKind>);
  for (const TerrainColliderKind collider : all_kinds<TerrainColliderKind>) {
    const std::string name(name_of(collider));
    Sums sums;
    for (uint64_t seed = 1; seed <= mushrooms; ++seed)
      play([&](Scene& scene) { mushroom(scene, seed); }, collider, sums);
    report_sums(report, name + "_mushrooms", sums);
    options.progress(++done / all);
    for (const auto& [scene_name, scene_of] : single_scenes) {
      Sums one;
      play(scene_of, collider, one);
      report_sums(report, name + "_" + scene_name, one);
      options.progress(++done / all);
    }
  }
  return report;
}

}  // namespace scree
