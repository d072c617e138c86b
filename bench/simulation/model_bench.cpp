// The model of work (server/work/work.h) against the clock: in every scene the sum of its ticks' prices is to
// be the time that they took, within a factor. The table by stage says which price is wrong; a fit says what
// the prices of the bodies' step would be on this machine.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>

#include "bench/support/benches.h"
#include "bench/support/priced_scenes.h"
#include "bench/support/scenes.h"
#include "server/work/limits.h"

namespace scree {

namespace {

constexpr double factor_max = 1.15;
/// Shorter ticks endanger nothing, and a model does not see their fixed costs.
constexpr double tick_min_ms = 1.0, fitted_min_ms = 4.0;

/// Blows side by side, one a tick.
std::vector<TickCost> blows(Recombination recombine, uint32_t a_side, float radius_m, uint32_t seeds,
                            int ticks) {
  WorldConfig config;
  config.methods.recombine = recombine;
  PricedScene scene(config);
  scene.generate(sphere({0.0F, ground_height_m(config.terrain, 0.0F, 0.0F), 0.0F}, 24.0F));
  BlowGrid grid(config.terrain, a_side, 2.25F * radius_m, radius_m, seeds);
  while (const auto blow = grid.next()) scene.ask(*blow);
  scene.settle(ticks);
  return scene.costs();
}

/// Carves and nothing else: each where nobody was before, its pieces removed by the next world.
std::vector<TickCost> carves(float radius_m, uint32_t seeds) {
  std::vector<TickCost> costs;
  for (uint32_t i = 0; i < 12; ++i) {
    PricedScene scene({});
    const CarveRequest blow =
        blow_at(scene.terrain(), 30.0F * static_cast<float>(i), 11.0F, radius_m, seeds, i);
    scene.generate(blow.shape);
    scene.ask(blow);
    for (int tick = 0; tick < 3; ++tick) scene.step();
    costs.insert(costs.end(), scene.costs().begin(), scene.costs().end());
  }
  return costs;
}

/// Sums over the ticks of a scene, milliseconds.
struct SceneSums {
  StageTimes stages;
  double clock_ms = 0.0, model_ms = 0.0;
  double worst_ms = 0.0, worst_model_ms = 0.0;
};

SceneSums sums_of(const std::vector<TickCost>& costs) {
  SceneSums sums;
  for (const TickCost& cost : costs) {
    const double clock_ms = cost.ms();
    if (clock_ms < tick_min_ms) continue;
    sums.clock_ms += clock_ms;
    sums.model_ms += cost.model_ms();
    for (size_t stage = 0; stage < tick_stages.size(); ++stage) {
      sums.stages.ms[stage] += cost.times.ms[stage];
      sums.stages.model_ms[stage] += cost.times.model_ms[stage];
    }
    if (clock_ms <= sums.worst_ms) continue;
    sums.worst_ms = clock_ms;
    sums.worst_model_ms = cost.model_ms();
  }
  return sums;
}

void report_scene(BenchReport& report, const std::string& name, const std::vector<TickCost>& costs) {
  const SceneSums sums = sums_of(costs);
  const double ratio = sums.clock_ms / std::max(sums.model_ms, 0.1);
  std::string table;
  for (const TickStageRow& row : tick_stages) {
    const double ms = sums.stages[row.stage], model_ms = sums.stages.model_ms[index_of(row.stage)];
    if (ms > 0.01 * sums.clock_ms || model_ms > 0.01 * sums.clock_ms)
      table += fmt::format("{}{} {:.1f}/{:.1f}", table.empty() ? "" : ", ", row.name, ms, model_ms);
  }
  report.condition(name, "clock/model by stage, ms: " + table);
  report.metric(name + "_clock_per_model", ratio);
  report.metric(name + "_worst_tick_ms", sums.worst_ms);
  report.metric(name + "_worst_tick_model_ms", sums.worst_model_ms);
  report.check(name, ratio <= factor_max && ratio >= 1.0 / factor_max,
               fmt::format("{:.0f} ms by the clock, {:.0f} by the model: {:.2f}; wanted within {}",
                           sums.clock_ms, sums.model_ms, ratio, factor_max));
}

constexpr size_t prices = 6;
using Prices = std::array<double, prices>;

Prices counts_of(const BodyCounts& bodies) {
  Prices counts{static_cast<double>(bodies.pieces),        static_cast<double>(bodies.awake),
                static_cast<double>(bodies.ground_points), static_cast<double>(bodies.contact_points),
                static_cast<double>(bodies.pairs),         static_cast<double>(bodies.overlaps)};
  for (size_t i = 1; i < prices; ++i) counts[i] *= bodies.steps;
  return counts;
}

/// The prices, none negative, by which the ticks' bodies cost what they took: least squares of the ratios, by
/// coordinates in turn.
Prices fitted(const std::vector<TickCost>& costs) {
  std::array<Prices, prices> products{};
  Prices sums{}, found{};
  for (const TickCost& cost : costs) {
    const StageTimes& times = cost.times;
    const bool only_looks = !times.acted[index_of(TickStage::buried)];
    const double us = 1e3 * (times[TickStage::bodies] + times[TickStage::rest] + times[TickStage::publish] +
                             (only_looks ? times[TickStage::buried] : 0.0));
    if (us < 1e3 * fitted_min_ms) continue;
    const Prices counts = counts_of(cost.work.bodies);
    for (size_t i = 0; i < prices; ++i) {
      sums[i] += counts[i] / us;
      for (size_t k = 0; k < prices; ++k) products[i][k] += counts[i] * counts[k] / (us * us);
    }
  }
  for (int round = 0; round < 2000; ++round)
    for (size_t i = 0; i < prices; ++i) {
      double rest = sums[i];
      for (size_t k = 0; k < prices; ++k) rest -= k == i ? 0.0 : products[i][k] * found[k];
      if (products[i][i] > 0.0) found[i] = std::max(0.0, rest / products[i][i]);
    }
  return found;
}

void report_fit(BenchReport& report, const std::vector<TickCost>& costs) {
  constexpr std::array<const char*, prices> names{"piece_cost_us",   "body_cost_us", "ground_point_cost_us",
                                                  "contact_cost_us", "pair_cost_us", "overlap_cost_us"};
  const Prices found = fitted(costs);
  for (size_t i = 0; i < prices; ++i) report.metric(std::string("fitted_") + names[i], found[i]);
}

struct Scene {
  std::string name;
  std::function<std::vector<TickCost>()> play;
};

std::vector<Scene> scenes() {
  using enum Recombination;
  return {
      {"slab_at_1_m", [] { return cut_slab(1.0F); }},
      {"slab_at_5_m", [] { return cut_slab(5.0F); }},
      {"crowd", [] { return blows(off, 5, 2.0F, 80, 400); }},
      {"crowd_of_small", [] { return blows(off, 8, 1.2F, 32, 400); }},
      {"heap", [] { return blows(facets, 4, 2.0F, 80, 2400); }},
      {"hundred_carves", [] { return blows(facets, 10, 2.0F, 64, 3600); }},
      {"carves_2_m", [] { return carves(2.0F, 32); }},
      {"carves_4_m", [] { return carves(4.0F, 64); }},
      {"carves_8_m", [] { return carves(8.0F, 8); }},
      {"large_pieces", [] { return large_pieces(10); }},
      {"slice", [] { return large_carve(Cutter::slice, 4.0F, 300); }},
      {"conform", [] { return large_carve(Cutter::conform, 4.0F, 300); }},
      {"large_slice", [] { return large_carve(Cutter::slice, 8.0F, 2000); }},
      {"large_conform", [] { return large_carve(Cutter::conform, 8.0F, 2000); }},
  };
}

}  // namespace

BenchReport run_model_bench(const BenchOptions& options) {
  BenchReport report;
  const std::vector<Scene> all = scenes();
  std::vector<TickCost> costs;
  for (size_t i = 0; i < all.size(); ++i) {
    if (options.part.empty() || options.part == all[i].name) {
      const std::vector<TickCost> of_scene = least_of(options.quick ? 1 : 3, all[i].play);
      report_scene(report, all[i].name, of_scene);
      costs.insert(costs.end(), of_scene.begin(), of_scene.end());
    }
    options.progress(static_cast<double>(i + 1) / static_cast<double>(all.size()));
  }
  report_fit(report, costs);
  return report;
}

}  // namespace scree
