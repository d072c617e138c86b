#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/stage_times.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

constexpr Tick blow_ticks = 600, ticks_between_blows = 12;
constexpr float blows_half_width_m = 10.0F, blow_radius_m = 1.6F;
constexpr uint32_t seeds_per_blow = 40;
/// The ratios of ticks that are wanted at most: each of the nested regions tells of every body.
constexpr double far_ratio_max = 1.1, nested_ratio_max = 2.0, counting_ratio_max = 1.3;

Region region_at(size_t number, glm::vec3 centre_m, float half_m) {
  Region region;
  region.name = fmt::format("region {}", number);
  region.centre_m = centre_m;
  region.half_m = glm::vec3(half_m);
  return region;
}

/// A world in which the same is done as in the others, and its ticks.
struct RegionsCase {
  const char* name;
  double ratio_max;
  std::unique_ptr<World> world = std::make_unique<World>(WorldConfig(), 1);
  std::vector<StageTimes> times{};
  uint64_t hash = 0;

  RegionsCase(const char* its_name, double its_ratio_max) : name(its_name), ratio_max(its_ratio_max) {}

  void set(Region region) {
    const Command command{0, 1, SetRegionRequest{std::move(region), 0.0F}};
    world->step({&command, 1});
  }
  void remove(const std::string& name_of_it) {
    const Command command{0, 1, RemoveRegionRequest{name_of_it}};
    world->step({&command, 1});
  }
};

/// As many regions as in the others have come and gone, so that pieces have the same ids.
void set_none(RegionsCase& of, size_t count = limits::regions_max) {
  for (size_t i = 0; i < count; ++i) of.set(region_at(i, glm::vec3(0.0F), 4.0F));
  for (size_t i = 0; i < count; ++i) of.remove(region_at(i, glm::vec3(0.0F), 4.0F).name);
}

/// As many as a world takes, far from everything.
void set_far(RegionsCase& of) {
  for (size_t i = 0; i < limits::regions_max; ++i) {
    Region region = region_at(i, {500.0F + static_cast<float>(i), 0.0F, 500.0F}, 4.0F);
    region.forbids = forbids::all;
    region.tells = region.counts = true;
    of.set(std::move(region));
  }
}

/// As many, in each other and over all that happens. They tell, and forbid what does not happen there.
void set_nested(RegionsCase& of) {
  for (size_t i = 0; i < limits::regions_max; ++i) {
    Region region = region_at(i, glm::vec3(0.0F), 40.0F + 0.5F * static_cast<float>(i));
    region.forbids = forbids::edits;
    region.tells = true;
    of.set(std::move(region));
  }
}

void set_counting(RegionsCase& of) {
  set_none(of, limits::regions_max - 1);
  Region region = region_at(0, glm::vec3(0.0F), 60.0F);
  region.counts = true;
  of.set(std::move(region));
}

double total_ms(const std::vector<StageTimes>& times) {
  double sum = 0.0;
  for (const StageTimes& one : times) sum += one.total_ms();
  return sum;
}

}  // namespace

BenchReport run_regions_bench(const BenchOptions& options) {
  BenchReport report;
  const Tick ticks = options.quick ? blow_ticks / 4 : blow_ticks;
  std::vector<RegionsCase> cases;
  cases.emplace_back("none", 1.0);
  cases.emplace_back("far", far_ratio_max);
  cases.emplace_back("nested", nested_ratio_max);
  cases.emplace_back("counting", counting_ratio_max);
  set_none(cases[0]);
  set_far(cases[1]);
  set_nested(cases[2]);
  set_counting(cases[3]);
  // Each has done as many ticks before the first blow.
  for (RegionsCase& one : cases)
    while (one.world->tick() <= 2 * limits::regions_max) one.world->step({});
  ScatteredBlows blows(cases[0].world->config().terrain, blows_half_width_m, blow_radius_m, seeds_per_blow,
                       1);
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::vector<Command> commands;
    if (tick % ticks_between_blows == 0) commands.push_back({0, static_cast<uint32_t>(tick), blows.next()});
    for (size_t turn = 0; turn < cases.size(); ++turn) {
      RegionsCase& one = cases[(turn + tick) % cases.size()];
      const auto delta = one.world->step(commands);
      one.times.push_back(delta->times);
      one.hash = delta->field_hash;
    }
    options.progress(static_cast<double>(tick + 1) / static_cast<double>(ticks));
  }
  for (const RegionsCase& one : cases) {
    report_stages(report, one.name, one.times);
    if (&one == &cases[0]) continue;
    const double ratio = total_ms(one.times) / total_ms(cases[0].times);
    report.metric(fmt::format("{}_ratio", one.name), ratio);
    report.check(fmt::format("{}_cost", one.name), ratio <= one.ratio_max,
                 fmt::format("{:.3f} times the ticks without regions, at most {}", ratio, one.ratio_max));
    report.check(fmt::format("{}_same_terrain", one.name), one.hash == cases[0].hash,
                 "the terrain is the same as without regions");
  }
  return report;
}

}  // namespace scree
