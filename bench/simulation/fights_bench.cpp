#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/stage_times.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::array<size_t, 3> thread_counts = {1, 2, 4};
constexpr float apart_m = 200.0F;
constexpr uint32_t blows_a_fight_side = 2;
constexpr uint32_t seeds_per_fight_blow = 80;
constexpr size_t fighting_wanted = 600;  ///< pieces alive in the ticks that are compared
constexpr Tick fight_ticks = 420;
constexpr double wanted_ratio = 1.7;

/// One world's ticks, each its least time of several rounds.
struct Fight {
  std::vector<StageTimes> times;
  std::vector<size_t> alive;
  std::vector<uint64_t> hashes;
};
using Fights = std::array<Fight, thread_counts.size()>;

/// Generated terrain is made at its first touch; here viewers have been looking at it for long.
void generate_fights(World& world) {
  const TerrainSource& terrain = world.config().terrain;
  for (const float x_m : {-0.5F * apart_m, 0.5F * apart_m})
    for (const float z_m : {-0.5F * apart_m, 0.5F * apart_m}) {
      const Shape all = sphere({x_m, ground_height_m(terrain, x_m, z_m), z_m}, 16.0F);
      gather(world.field(), band_box(in_voxels(all, terrain.voxel_size_m)));
    }
}

/// The same session on every number of threads, in turns tick by tick: other work of the machine slows all.
Fights fight(uint32_t round) {
  std::array<std::unique_ptr<World>, thread_counts.size()> worlds;
  for (size_t i = 0; i < worlds.size(); ++i) {
    worlds[i] = std::make_unique<World>(WorldConfig(), thread_counts[i]);
    generate_fights(*worlds[i]);
  }
  FarFights blows(worlds[0]->config().terrain, apart_m, blows_a_fight_side, 2.0F, seeds_per_fight_blow);
  Fights seen;
  for (Tick tick = 0; tick < fight_ticks; ++tick) {
    std::vector<Command> commands;
    if (const auto blow = blows.next()) commands.push_back({0, static_cast<uint32_t>(tick), *blow});
    for (size_t turn = 0; turn < worlds.size(); ++turn) {
      const size_t i = (turn + tick + round) % worlds.size();
      const auto delta = worlds[i]->step(commands);
      seen[i].times.push_back(delta->times);
      seen[i].alive.push_back(delta->pieces.size());
      seen[i].hashes.push_back(delta->state_hash);
    }
  }
  return seen;
}

void assign_minimum(Fights& least, const Fights& again) {
  for (size_t i = 0; i < least.size(); ++i) {
    CHECK(least[i].hashes == again[i].hashes);
    for (size_t tick = 0; tick < least[i].times.size(); ++tick)
      for (const TickStageRow& row : tick_stages)
        least[i].times[tick][row.stage] =
            std::min(least[i].times[tick][row.stage], again[i].times[tick][row.stage]);
  }
}

struct FightTime {
  double bodies_ms = 0.0;
  double tick_ms = 0.0;
  double ticks = 0.0;
};

/// The time of the ticks with fighting_wanted pieces and more.
FightTime time_of(const Fight& fight) {
  FightTime sum;
  for (size_t tick = 0; tick < fight.times.size(); ++tick) {
    if (fight.alive[tick] < fighting_wanted) continue;
    sum.bodies_ms += fight.times[tick][TickStage::bodies];
    sum.tick_ms += fight.times[tick].total_ms();
    sum.ticks += 1.0;
  }
  return sum;
}

}  // namespace

BenchReport run_fights_bench(const BenchOptions& options) {
  BenchReport report;
  report.metric("cores", std::thread::hardware_concurrency());
  const uint32_t rounds = options.quick ? 1 : 5;
  Fights fights;
  for (uint32_t round = 0; round < rounds; ++round) {
    Fights again = fight(round);
    if (round == 0)
      fights = std::move(again);
    else
      assign_minimum(fights, again);
    options.progress(static_cast<double>(round + 1) / rounds);
  }
  std::array<FightTime, thread_counts.size()> times;
  for (size_t i = 0; i < fights.size(); ++i) {
    const std::string name = fmt::format("threads_{}", thread_counts[i]);
    times[i] = time_of(fights[i]);
    report_stages(report, name, fights[i].times);
    report.metric(name + "_ticks_per_s", 1e3 * times[i].ticks / times[i].tick_ms);
    report.metric(name + "_bodies_steps_per_s", 1e3 * times[i].ticks / times[i].bodies_ms);
    if (i == 0) continue;
    const auto differ = std::ranges::mismatch(fights[0].hashes, fights[i].hashes);
    report.check(name + "_same_hashes", differ.in1 == fights[0].hashes.end(),
                 fmt::format("hashes agree for {} of {} ticks", differ.in1 - fights[0].hashes.begin(),
                             fights[0].hashes.size()));
  }
  report.metric("alive_most", static_cast<double>(*std::ranges::max_element(fights[0].alive)));
  report.metric("ticks_compared", times[0].ticks);
  report.metric("two_threads_ticks_ratio", times[0].tick_ms / times[1].tick_ms);
  const double bodies_ratio = times[0].bodies_ms / times[1].bodies_ms;
  report.metric("two_threads_bodies_ratio", bodies_ratio);
  report.check("two_threads_bodies", bodies_ratio >= wanted_ratio,
               fmt::format("{:.2f} times the throughput of one, wanted {}", bodies_ratio, wanted_ratio));
  return report;
}

}  // namespace scree
