#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/blow_scenes.h"
#include "server/world/rules.h"

namespace scree {

namespace {

/// What breaks at each speed, and beside it by the rules before, where blows only dented.
void play(const BlowScene& scene, const BenchOptions& options, BenchReport& report) {
  size_t least = 0;
  int64_t least_first = 0;
  bool grows = true, first_grows = true;
  for (size_t i = 0; i < scene.speeds_m_s.size(); i += options.quick ? 3 : 1) {
    const float speed_m_s = scene.speeds_m_s[i];
    const BlowOutcome now = strike(scene, speed_m_s, rules::blows);
    const BlowOutcome before = strike(scene, speed_m_s, rules::by_place);
    const std::string name = fmt::format("{}_{:.1f}_m_s", scene.name, speed_m_s);
    report.metric(name + "_energy_kj", now.energy_j / 1000.0);
    report.metric(name + "_places_gone", static_cast<double>(now.gone));
    report.metric(name + "_places_gone_before", static_cast<double>(before.gone));
    report.metric(name + "_first_break_voxels", static_cast<double>(now.first));
    report.metric(name + "_voxels_gone", static_cast<double>(now.voxels));
    report.metric(name + "_voxels_gone_before", static_cast<double>(before.voxels));
    report.metric(name + "_energy_left_kj", now.energy_left_j / 1000.0);
    report.metric(name + "_worst_stage_ms", now.worst_ms);
    grows = grows && 10 * now.gone >= 9 * least;
    // One that is slower sinks a little more on its way, and strikes lower.
    first_grows = first_grows && 10 * now.first >= 9 * least_first;
    least = now.gone;
    least_first = now.first;
  }
  report.check(scene.name + "_first_break_monotone", first_grows, "a harder blow breaks no less at once");
  // Where debris falls afterwards differs by a few hundredths.
  report.check(scene.name + "_monotone", grows, "a harder blow breaks no less");
  report.check(scene.name + "_breaks", least > 0,
               fmt::format("the hardest blow: {} of {} places gone", least, scene.places_m.size()));
}

}  // namespace

BenchReport run_blows_bench(const BenchOptions& options) {
  BenchReport report;
  const std::vector<BlowScene> scenes = blow_scenes();
  for (const BlowScene& scene : scenes) {
    play(scene, options, report);
    options.progress(static_cast<double>(&scene - scenes.data() + 1) / static_cast<double>(scenes.size()));
  }
  return report;
}

}  // namespace scree
