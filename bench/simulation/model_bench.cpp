// The model of work (server/work/work.h) against the clock: in every scene the sum of its ticks' prices is to
// be the time that they took, within a factor. The table by stage says which price is wrong; a fit says what
// the prices of the bodies' step would be on this machine.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

constexpr double factor_max = 1.15;
/// Shorter ticks endanger nothing, and a model does not see their fixed costs.
constexpr double tick_min_ms = 1.0, fitted_min_ms = 4.0;

struct TickCost {
  StageTimes times;
  TickWork work;
  uint64_t state_hash = 0;
};

/// A world with what a scene builds in it.
class Stand {
 public:
  explicit Stand(const WorldConfig& config) : world_(config) {}

  void step(const std::vector<Command>& commands = {}) {
    const auto delta = world_.step(commands);
    alive_ = delta->pieces.size();
    costs_.push_back({delta->times, delta->work, delta->state_hash});
  }
  void ask(const Request& request) { step({{0, 0, request}}); }
  void settle(int ticks_max) {
    for (int tick = 0; tick < ticks_max && (tick < 60 || alive_ > 0); ++tick) step();
  }
  void forget() { costs_.clear(); }
  const std::vector<TickCost>& costs() const { return costs_; }
  const TerrainSource& terrain() const { return world_.config().terrain; }
  /// Ground that was looked at before, as far as a blow's search goes: no tick generates it.
  void generate(const Shape& shape) {
    gather(world_.field(), band_box(in_voxels(shape, terrain().voxel_size_m)).grown(64));
  }

 private:
  World world_;
  size_t alive_ = 0;
  std::vector<TickCost> costs_;
};

WorldConfig flat() {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  return config;
}

CarveRequest cut(const Shape& shape) {
  CarveRequest request;
  request.shape = shape;
  request.seeds = 4;
  request.impact_m = centre_of(shape);
  return request;
}

/// A slab of 60 × 20 × 6 m stands; a slit of half a metre cuts through it.
std::vector<TickCost> slab(float height_m) {
  Stand stand(flat());
  for (float x_m = -22.5F; x_m < 30.0F; x_m += 15.0F)
    for (const float y_m : {5.0F, 15.0F})
      stand.ask(FillRequest{box({x_m, y_m, 0.0F}, {7.75F, 5.25F, 3.25F})});
  stand.settle(120);
  stand.forget();
  std::vector<Command> cuts;
  for (float x_m = -26.25F; x_m < 30.0F; x_m += 7.5F)
    cuts.push_back({0, 0, cut(box({x_m, height_m, 0.0F}, {3.9F, 0.25F, 3.5F}))});
  stand.step(cuts);
  stand.settle(1200);
  return stand.costs();
}

/// Blows side by side, one a tick.
std::vector<TickCost> blows(Recombination recombine, uint32_t a_side, float radius_m, uint32_t seeds,
                            int ticks) {
  WorldConfig config;
  config.methods.recombine = recombine;
  Stand stand(config);
  stand.generate(sphere({0.0F, ground_height_m(config.terrain, 0.0F, 0.0F), 0.0F}, 24.0F));
  BlowGrid grid(config.terrain, a_side, 2.25F * radius_m, radius_m, seeds);
  while (const auto blow = grid.next()) stand.ask(*blow);
  stand.settle(ticks);
  return stand.costs();
}

/// Carves and nothing else: each where nobody was before, its pieces removed by the next world.
std::vector<TickCost> carves(float radius_m, uint32_t seeds) {
  std::vector<TickCost> costs;
  for (uint32_t i = 0; i < 12; ++i) {
    Stand stand({});
    const CarveRequest blow =
        blow_at(stand.terrain(), 30.0F * static_cast<float>(i), 11.0F, radius_m, seeds, i);
    stand.generate(blow.shape);
    stand.ask(blow);
    for (int tick = 0; tick < 3; ++tick) stand.step();
    costs.insert(costs.end(), stand.costs().begin(), stand.costs().end());
  }
  return costs;
}

std::vector<TickCost> large_carve(Cutter cutter, float radius_m, uint32_t seeds) {
  WorldConfig config = flat();
  config.methods.cutter = cutter;
  Stand stand(config);
  const CarveRequest blow = blow_at(config.terrain, 0.0F, 0.0F, radius_m, seeds, 1);
  stand.generate(blow.shape);
  stand.ask(blow);
  stand.settle(3600);
  return stand.costs();
}

/// The largest carves into few pieces, which merge whole.
std::vector<TickCost> large_pieces(int carves) {
  Stand stand({});
  for (int i = 0; i < carves; ++i) {
    const CarveRequest blow = blow_at(stand.terrain(), -900.0F + 90.0F * static_cast<float>(i), 0.0F,
                                      limits::edit_reach_max_m, 8, static_cast<uint32_t>(i));
    stand.generate(blow.shape);
    stand.ask(blow);
    for (int tick = 0; tick < 30; ++tick) stand.step();
  }
  stand.settle(3600);
  return stand.costs();
}

/// Each tick's least time over several runs of the same scene, to exclude other work of the machine.
std::vector<TickCost> least_of(int runs, const std::function<std::vector<TickCost>()>& play) {
  std::vector<TickCost> least = play();
  for (int run = 1; run < runs; ++run) {
    const std::vector<TickCost> again = play();
    CHECK(again.size() == least.size());
    for (size_t i = 0; i < least.size(); ++i) {
      CHECK(again[i].state_hash == least[i].state_hash);
      for (size_t stage = 0; stage < tick_stages.size(); ++stage)
        least[i].times.ms[stage] = std::min(least[i].times.ms[stage], again[i].times.ms[stage]);
    }
  }
  return least;
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
    const double clock_ms = cost.times.total_ms();
    if (clock_ms < tick_min_ms) continue;
    sums.clock_ms += clock_ms;
    sums.model_ms += 1e-3 * cost.work.estimate_us;
    for (size_t stage = 0; stage < tick_stages.size(); ++stage) {
      sums.stages.ms[stage] += cost.times.ms[stage];
      sums.stages.model_ms[stage] += cost.times.model_ms[stage];
    }
    if (clock_ms <= sums.worst_ms) continue;
    sums.worst_ms = clock_ms;
    sums.worst_model_ms = 1e-3 * cost.work.estimate_us;
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
      {"slab_at_1_m", [] { return slab(1.0F); }},
      {"slab_at_5_m", [] { return slab(5.0F); }},
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
