#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/stage_times.h"
#include "shared/base/quantile.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr uint64_t persons = 64;
constexpr Tick walked_ticks = 1200, ticks_between_blows = 10, ticks_a_walk = 90;
constexpr float rubble_half_width_m = 10.0F, blow_radius_m = 1.6F;
constexpr uint32_t seeds_per_blow = 40;
constexpr double wanted_p99_ms = 5.0;

WorldConfig world_of(Persons kind) {
  WorldConfig config;
  config.service.persons = kind;
  return config;
}

/// They stand in a square among the blows.
std::vector<Command> all_stand(const TerrainSource& terrain) {
  std::vector<Command> commands;
  for (uint64_t i = 0; i < persons; ++i) {
    const float x_m = 2.5F * static_cast<float>(i % 8) - 8.75F,
                z_m = 2.5F * static_cast<float>(i / 8) - 8.75F;
    commands.push_back(
        {1 + i, 1, StandRequest{glm::vec3(x_m, ground_height_m(terrain, x_m, z_m) + 0.2F, z_m)}});
  }
  return commands;
}

/// Each goes somewhere for a while, some of them fast, back to the middle where it is far away.
class Walks {
 public:
  void add(std::vector<Command>& commands, Tick tick, const TickDelta& before) {
    for (const PersonPlace& person : before.persons) {
      WalkInput& input = inputs_[person.session - 1];
      const glm::vec3 at_m = person.walker.feet_m;
      if ((tick + person.session * 7) % ticks_a_walk == 0 || std::hypot(at_m.x, at_m.z) > 14.0F) {
        const bool is_far = std::hypot(at_m.x, at_m.z) > 12.0F;
        const float angle = is_far ? std::atan2(-at_m.z, -at_m.x) : 6.2831853F * random_.next();
        input = {{std::cos(angle), 0.0F, std::sin(angle)}, random_.next() < 0.3F, random_.next() < 0.1F};
      }
      commands.push_back({person.session, static_cast<uint32_t>(tick + 2), WalkRequest{input}});
    }
  }

 private:
  struct Numbers {
    uint64_t state = 7;
    float next() {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<float>(state >> 40U) / static_cast<float>(1U << 24U);
    }
  };
  std::array<WalkInput, persons> inputs_{};
  Numbers random_;
};

}  // namespace

BenchReport run_persons_bench(const BenchOptions& options) {
  BenchReport report;
  const Tick ticks = options.quick ? walked_ticks / 4 : walked_ticks;
  World alone(world_of(Persons::fly), 1), walked(world_of(Persons::walk), 1);
  alone.step({});
  auto last = walked.step(all_stand(walked.config().terrain));
  ScatteredBlows blows(alone.config().terrain, rubble_half_width_m, blow_radius_m, seeds_per_blow, 1);
  Walks walks;
  std::vector<StageTimes> without, with;
  std::vector<double> stage_ms;
  size_t pieces = 0, hurt = 0, on_foot = 0;
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::vector<Command> commands;
    if (tick % ticks_between_blows == 0) commands.push_back({0, static_cast<uint32_t>(tick), blows.next()});
    without.push_back(alone.step(commands)->times);
    walks.add(commands, tick, *last);
    last = walked.step(commands);
    with.push_back(last->times);
    stage_ms.push_back(last->times[TickStage::persons]);
    pieces += last->pieces.size();
    on_foot += last->persons.size();
    for (const Event& event : last->told) hurt += event.kind == EventKind::hurt ? 1 : 0;
    options.progress(static_cast<double>(tick + 1) / static_cast<double>(ticks));
  }
  report_stages(report, "fly", without);
  report_stages(report, "walk", with);
  const double p99_ms = quantile(stage_ms, 0.99);
  report.metric("persons_mean", static_cast<double>(on_foot) / static_cast<double>(ticks));
  report.metric("pieces_mean", static_cast<double>(pieces) / static_cast<double>(ticks));
  report.metric("hurt_events", static_cast<double>(hurt));
  report.check(
      "persons_cost", p99_ms <= wanted_p99_ms,
      fmt::format("{:.2f} ms a tick for {} persons, p99, at most {}", p99_ms, persons, wanted_p99_ms));
  report.check("persons_stay", on_foot == persons * ticks, fmt::format("{} of {}", on_foot, persons * ticks));
  return report;
}

}  // namespace scree
