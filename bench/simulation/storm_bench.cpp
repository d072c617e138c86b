#include <algorithm>
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scene_blows.h"
#include "bench/support/scenes.h"
#include "bench/support/stage_times.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr uint32_t blows_a_side = 4;
constexpr uint32_t seeds_per_blow = 80;  ///< 16 of them: more than 1,000 pieces, some seeds lie in thin rock
constexpr size_t alive_wanted = 1000;
constexpr int blasts = 5;
constexpr Tick blast_ticks_max = 1200;
constexpr Tick half_merged_ticks = 240, all_merged_ticks = 720;

/// The cost of one tick of the storm, and the number of pieces alive after it.
struct StormTick {
  double total_ms = 0.0;
  StageTimes times;
  size_t alive = 0;
  uint64_t state_hash = 0;
  TickWork work;
};

WorldConfig storm_config(bool merging) {
  WorldConfig config;
  if (!merging) config.methods.recombine = Recombination::off;
  return config;
}

/// Generated terrain is made at its first touch; here a viewer has been looking at it for long.
void generate_around(World& world, const BenchOptions& options) {
  const TerrainSource& terrain = world.config().terrain;
  const glm::vec3 centre_m = options.scene != nullptr
                                 ? options.scene->target_m
                                 : glm::vec3(0.0F, ground_height_m(terrain, 0.0F, 0.0F), 0.0F);
  const Shape all = sphere(centre_m, 20.0F);
  gather(world.field(), band_box(in_voxels(all, terrain.voxel_size_m)));
}

/// Blows in a square, or as many about the strikes of a scene.
std::vector<CarveRequest> storm_blows(const BenchOptions& options, const TerrainSource& terrain) {
  std::vector<CarveRequest> blows;
  if (options.scene != nullptr) {
    SceneBlows of_scene(*options.scene, 2.0F, seeds_per_blow, 5);
    while (blows.size() < size_t{blows_a_side} * blows_a_side) blows.push_back(of_scene.next());
    return blows;
  }
  BlowGrid grid(terrain, blows_a_side, 4.5F, 2.0F, seeds_per_blow);
  while (const auto blow = grid.next()) blows.push_back(*blow);
  return blows;
}

/// All blows, one a tick, until nothing is alive any more or `ticks_max` have passed.
std::vector<StormTick> rage(World& world, const BenchOptions& options, Tick ticks_max) {
  generate_around(world, options);
  const std::vector<CarveRequest> blows = storm_blows(options, world.config().terrain);
  std::vector<StormTick> ticks;
  while (ticks.size() < ticks_max) {
    std::vector<Command> commands;
    if (ticks.size() < blows.size())
      commands.push_back({0, static_cast<uint32_t>(ticks.size()), blows[ticks.size()]});
    const auto delta = world.step(commands);
    ticks.push_back(
        {delta->times.total_ms(), delta->times, delta->pieces.size(), delta->state_hash, delta->work});
    if (delta->pieces.empty() && commands.empty()) break;
  }
  return ticks;
}

/// Keeps each tick's least time over several runs of the same storm, to exclude other work of the machine.
void assign_minimum(std::vector<StormTick>& least, const std::vector<StormTick>& again) {
  CHECK(least.size() == again.size());
  for (size_t i = 0; i < least.size(); ++i) {
    CHECK(least[i].state_hash == again[i].state_hash);
    least[i].total_ms = std::min(least[i].total_ms, again[i].total_ms);
    for (const TickStageRow& row : tick_stages)
      least[i].times[row.stage] = std::min(least[i].times[row.stage], again[i].times[row.stage]);
  }
}

/// Median tick of an untouched world, and of one after the storm; in turns, so that other work of the machine
/// slows both.
std::pair<double, double> idle_us(World& world, size_t rounds) {
  World fresh(world.config());
  std::vector<double> before, after;
  for (size_t i = 0; i < rounds; ++i) {
    before.push_back(fresh.step({})->times.total_ms() * 1e3);
    after.push_back(world.step({})->times.total_ms() * 1e3);
  }
  return {quantile(before, 0.5), quantile(after, 0.5)};
}

std::vector<double> total_of(const std::vector<StormTick>& ticks, size_t alive_min) {
  std::vector<double> total_ms;
  for (const StormTick& tick : ticks)
    if (tick.alive >= alive_min) total_ms.push_back(tick.total_ms);
  return total_ms;
}

/// Reports the work that was put off or left out, and how well the model's estimate follows the clock.
void report_work(BenchReport& report, const std::string& when, const std::vector<StormTick>& ticks) {
  double cut = 0.0, sooner = 0.0, waiting = 0.0, put_off = 0.0, left_out = 0.0;
  std::vector<double> per_estimate;
  for (const auto& [total_ms, times, alive, hash, work] : ticks) {
    cut += work.has_leftovers() ? 1.0 : 0.0;
    sooner += work.merging_sooner ? 1.0 : 0.0;
    waiting = std::max(waiting, static_cast<double>(work.requests_waiting));
    put_off = std::max(put_off, static_cast<double>(work.merges_put_off));
    left_out += work.breaks_left_out + work.dents_left_out;
    if (work.estimate_us > 1000) per_estimate.push_back(total_ms * 1e3 / work.estimate_us);
  }
  report.metric(when + "_ticks_cut_short", cut);
  report.metric(when + "_ticks_merging_sooner", sooner);
  report.metric(when + "_requests_waiting_most", waiting);
  report.metric(when + "_merges_put_off_most", put_off);
  report.metric(when + "_breaks_dents_left_out", left_out);
  if (per_estimate.empty()) return;
  report.metric(when + "_time_per_estimate_median", quantile(per_estimate, 0.5));
  report.metric(when + "_time_per_estimate_p99", quantile(per_estimate, 0.99));
}

/// `wanted`: pieces alive at once that the storm is to have.
void report_storm(BenchReport& report, const std::string& when, const std::vector<StormTick>& ticks,
                  size_t wanted) {
  std::vector<StageTimes> times;
  size_t most = 0;
  for (const StormTick& tick : ticks) {
    times.push_back(tick.times);
    most = std::max(most, tick.alive);
  }
  const std::vector<double> all_ms = total_of(ticks, 0), crowded_ms = total_of(ticks, wanted);
  const double p99_ms = quantile(all_ms, 0.99);
  report.metric(when + "_alive_most", static_cast<double>(most));
  report.metric(when + "_alive_last", static_cast<double>(ticks.back().alive));
  report.metric(when + "_ticks", static_cast<double>(ticks.size()));
  report.metric(when + "_tick_median_ms", quantile(all_ms, 0.5));
  report.metric(when + "_tick_p99_ms", p99_ms);
  report.metric(when + "_tick_worst_ms", quantile(all_ms, 1.0));
  report_stages(report, when, times);
  report_work(report, when, ticks);
  report.metric(when + "_crowded_ticks", static_cast<double>(crowded_ms.size()));
  report.check(when + "_alive", !crowded_ms.empty(),
               fmt::format("{} pieces at once, wanted {}", most, wanted));
  if (crowded_ms.empty()) return;
  const double crowded_p99_ms = quantile(crowded_ms, 0.99);
  report.metric(when + "_crowded_median_ms", quantile(crowded_ms, 0.5));
  report.metric(when + "_crowded_p99_ms", crowded_p99_ms);
  report.check(when + "_tick_p99", p99_ms <= 16.6 && crowded_p99_ms <= 16.6,
               fmt::format("{:.1f} ms, with {} pieces and more {:.1f} ms; wanted at most 16.6", p99_ms,
                           wanted, crowded_p99_ms));
}

/// On one thread, or with `threads` 0 on all cores.
std::vector<StormTick> storm(BenchReport& report, bool merging, size_t threads, const BenchOptions& options) {
  const std::string when = std::string(merging ? "stamp" : "off") + (threads == 1 ? "" : "_all_cores");
  const Tick ticks_max = merging ? 3600 : 900;
  const int rounds = options.quick ? 1 : 3;
  std::vector<StormTick> ticks;
  for (int round = 0; round < rounds; ++round) {
    const std::unique_ptr<World> made = world_of(options, storm_config(merging), threads);
    World& world = *made;
    std::vector<StormTick> again = rage(world, options, ticks_max);
    if (round == 0)
      ticks = std::move(again);
    else
      assign_minimum(ticks, again);
    if (round + 1 < rounds) continue;
    const auto [before_us, after_us] = idle_us(world, options.quick ? 100 : 2000);
    report.metric(when + "_before_median_us", before_us);
    report.metric(when + "_after_median_us", after_us);
    if (merging)
      report.check(
          "settled", after_us <= 1.05 * before_us,
          fmt::format("{:.2f} us a tick after, {:.2f} us before; wanted within 5 %", after_us, before_us));
  }
  report_storm(report, when, ticks, options.scene != nullptr ? alive_wanted / 4 : alive_wanted);
  return ticks;
}

/// The storm on one thread and on all cores: the hashes must be the same.
void storms(BenchReport& report, bool merging, const BenchOptions& options) {
  const std::vector<StormTick> alone = storm(report, merging, 1, options);
  const std::vector<StormTick> shared = storm(report, merging, 0, options);
  const auto differ =
      std::ranges::mismatch(alone, shared, {}, &StormTick::state_hash, &StormTick::state_hash);
  report.check(std::string(merging ? "stamp" : "off") + "_same_on_all_cores",
               differ.in1 == alone.end() && differ.in2 == shared.end(),
               fmt::format("hashes agree for {} of {} ticks", differ.in1 - alone.begin(), alone.size()));
}

/// Ticks until the given share of a blow's pieces is terrain again; blast_ticks_max when it never is.
struct Merged {
  Tick half = blast_ticks_max;
  Tick all = blast_ticks_max;
};

Merged blast(uint32_t number) {
  const WorldConfig config;
  World world(config);
  const float x_m = 12.0F * static_cast<float>(number);
  const CarveRequest blow = blow_at(config.terrain, x_m, -0.5F * x_m, 2.0F, 64, number);
  const Command command{0, 0, blow};
  size_t made = world.step({&command, 1})->pieces.size();
  size_t merged = 0;
  Merged times;
  for (Tick tick = 1; tick < blast_ticks_max && times.all == blast_ticks_max; ++tick) {
    const auto delta = world.step({});
    for (const AppliedOperation& applied : delta->operations) merged += pieces_merged_by(applied.operation);
    made = std::max(made, merged + delta->pieces.size());
    if (2 * merged >= made) times.half = std::min(times.half, tick);
    if (delta->pieces.empty()) times.all = tick;
  }
  return times;
}

void blast_again(BenchReport& report) {
  Merged worst{0, 0};
  for (int i = 0; i < blasts; ++i) {
    const Merged times = blast(static_cast<uint32_t>(i));
    worst = {std::max(worst.half, times.half), std::max(worst.all, times.all)};
  }
  report.metric("blasts", blasts);
  report.metric("blast_half_merged_worst_s", static_cast<double>(worst.half) / 60.0);
  report.metric("blast_all_merged_worst_s", static_cast<double>(worst.all) / 60.0);
  report.check("blast_half_merged", worst.half <= half_merged_ticks,
               fmt::format("tick {} at worst, wanted {}", worst.half, half_merged_ticks));
  report.check("blast_all_merged", worst.all <= all_merged_ticks,
               fmt::format("tick {} at worst, wanted {}", worst.all, all_merged_ticks));
}

}  // namespace

BenchReport run_storm_bench(const BenchOptions& options) {
  BenchReport report;
  report.metric("cores", std::thread::hardware_concurrency());
  storms(report, true, options);
  options.progress(0.4);
  storms(report, false, options);
  options.progress(0.9);
  if (options.scene == nullptr) blast_again(report);
  options.progress(1.0);
  return report;
}

}  // namespace scree
