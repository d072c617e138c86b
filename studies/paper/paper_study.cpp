#include <filesystem>

#include "bench/support/drawing.h"
#include "studies/paper/findings/composition.h"
#include "studies/paper/measure.h"
#include "studies/paper/session.h"
#include "studies/support/studies.h"

namespace scree {
namespace {

/// Shares of the study's time, in the order of its parts.
constexpr double settings_share = 0.5, carving_share = 0.15, rebuilds_share = 0.2;

paper::Conditions conditions_of(const Stage& stage, const paper::Plan& plan, const StudyOptions& options) {
  const uint32_t rate_hz = paper::session_config().tick_rate_hz;
  paper::Conditions conditions{.quick = options.quick,
                               .driver = stage.renderer->description(),
                               .software = is_software(stage.renderer->description()),
                               .full_width = paper::full_width,
                               .full_height = paper::full_height,
                               .session_width = paper::full_width * plan.session_percent / 100,
                               .session_height = paper::full_height * plan.session_percent / 100,
                               .setting_s = static_cast<double>(plan.setting_ticks) / rate_hz,
                               .rounds = plan.rounds,
                               .tick_rate_hz = rate_hz};
  if (std::filesystem::exists(std::filesystem::path(options.folder) / "matrix.md"))
    conditions.matrix = "[the matrix of all combinations](matrix.md)";
  return conditions;
}

}  // namespace

Result<StudyResult> run_paper_study(const StudyOptions& options) {
  if (Result<void> can = check_plots_can_be_drawn(); !can) return fail(can.error().message);
  Result<std::unique_ptr<Stage>> made = Stage::create(paper::view_radius_m);
  if (!made) return fail(made.error().message);
  Stage& stage = **made;
  // As the paper's program draws.
  stage.renderer->set_fineness({.render_scale = 1.0F, .shadow_map_side = 0, .samples = 0, .contacts = false});
  const paper::Plan plan = paper::plan_of(options.quick, is_software(stage.renderer->description()));
  paper::Findings found{.conditions = conditions_of(stage, plan, options)};
  const auto part = [&](double from, double share) {
    return [&options, from, share](double fraction) { options.progress(from + share * fraction); };
  };
  if (auto done = paper::measure_settings(stage, plan, part(0.0, settings_share), found); !done)
    return fail(done.error().message);
  auto carving = paper::measure_carving(stage, plan, part(settings_share, carving_share));
  if (!carving) return fail(carving.error().message);
  found.carving = std::move(*carving);
  auto rebuild = paper::measure_rebuilds(stage, plan, part(settings_share + carving_share, rebuilds_share));
  if (!rebuild) return fail(rebuild.error().message);
  found.rebuild = std::move(*rebuild);
  const double before = settings_share + carving_share + rebuilds_share;
  auto merging = paper::measure_merging(stage, plan, part(before, 1.0 - before));
  if (!merging) return fail(merging.error().message);
  found.merging = std::move(*merging);
  options.progress(1.0);
  return paper::compose(found);
}

}  // namespace scree
