// The cost of a raymarched frame against the number of carves, beside the paper's list of carves; and a
// comparison of its picture with that of an atlas newly built from the same field.
#include <fmt/format.h>

#include "bench/peers/csg_list.h"
#include "bench/support/benches.h"
#include "bench/support/drawing.h"

namespace scree {

namespace {

const TerrainSource terrain{TerrainKind::noise, 1, 0.25F};
constexpr float view_radius_m = 96.0F;
constexpr int width = 640;
constexpr int height = 360;
constexpr float half_width_m = 40.0F;
constexpr float radius_m = 1.5F;
/// Quantile of the frames' times that counts as the time on an idle machine.
constexpr double undisturbed = 0.1;

/// From over the carved ground, across it.
Camera over_the_ground() {
  Camera camera;
  camera.eye_m = {0.0F, 16.0F, 46.0F};
  camera.pitch = -0.38F;
  return camera;
}

Result<std::unique_ptr<DrawMethod>> make_raymarch(Stage& stage) {
  return method_named("raymarch")->make(stage.pool, view_radius_m);
}

/// Whether the picture is that of an atlas that saw no edit, only the field as it is.
Result<void> compare_with_fresh(Stage& stage, Drawing& drawing, BenchReport& report) {
  const Result<Image> lived = drawing.picture(width, height);
  Result<std::unique_ptr<DrawMethod>> fresh = make_raymarch(stage);
  if (!fresh) return fail(fresh.error().message);
  drawing.show_by(std::move(*fresh));
  drawing.finish();
  const Result<Image> afresh = drawing.picture(width, height);
  if (!lived || !afresh) return fail((!lived ? lived : afresh).error().message);
  const size_t differing = differing_pixels(*lived, *afresh);
  report.check("pixels_of_a_fresh_atlas", differing == 0,
               fmt::format("{} pixels differ, wanted none", differing));
  return {};
}

/// The scene of the options, or noise.
std::unique_ptr<Drawing> drawing_of_rays(Stage& stage, std::unique_ptr<DrawMethod> method,
                                         const SceneSetup* scene) {
  if (scene != nullptr) return std::make_unique<Drawing>(stage, std::move(method), *scene);
  auto drawing = std::make_unique<Drawing>(stage, terrain, std::move(method));
  drawing->camera = over_the_ground();
  return drawing;
}

/// One world for each number of carves, all of the same hundred places: pictures that differ only in how
/// many edits made them. Frames take turns, so that all see the same machine.
Result<void> measure_atlas(Stage& stage, const BenchOptions& options, BenchReport& report) {
  std::vector<int> carves{0, 100, 1000};
  if (!options.quick) carves.push_back(10000);
  std::vector<std::unique_ptr<Drawing>> drawings;
  for (const int count : carves) {
    Result<std::unique_ptr<DrawMethod>> method = make_raymarch(stage);
    if (!method) return fail(method.error().message);
    drawings.push_back(drawing_of_rays(stage, std::move(*method), options.scene.get()));
    Drawing& drawing = *drawings.back();
    drawing.finish();
    drawing.carve(count, half_width_m, radius_m, 7);
    const double update_ms = drawing.finish();
    if (count > 0)
      report.metric(fmt::format("atlas_update_us_a_carve_of_{}", count), update_ms * 1000.0 / count);
    options.progress(0.2 * static_cast<double>(drawings.size()));
  }
  std::vector<std::vector<double>> times_ms(carves.size());
  for (int i = 0; i < (options.quick ? 3 : 15); ++i)
    for (size_t j = 0; j < drawings.size(); ++j) {
      const Result<double> frame = drawings[j]->frame_ms(width, height, 1);
      if (!frame) return fail(frame.error().message);
      times_ms[j].push_back(*frame);
    }
  for (size_t j = 0; j < carves.size(); ++j)
    report.metric(fmt::format("atlas_{}_carves_frame_ms", carves[j]), quantile(times_ms[j], undisturbed));
  const double growth = quantile(times_ms.back(), undisturbed) / quantile(times_ms.front(), undisturbed);
  report.metric("atlas_last_over_first", growth);
  report.check("atlas_flat", growth <= 1.10,
               fmt::format("{:.3f} times the first frame after {} carves, wanted at most 1.10", growth,
                           carves.back()));
  report.metric("atlas_gpu_mib", static_cast<double>(gpu_bytes_of(drawings.back()->method().stats().memory)) /
                                     (1024.0 * 1024.0));
  return compare_with_fresh(stage, *drawings.back(), report);
}

Result<void> measure_list(Stage& stage, const BenchOptions& options, BenchReport& report) {
  for (const int carves : {0, 10, 100}) {
    Result<std::unique_ptr<DrawMethod>> nothing = peers::make_csg_list_method({});
    if (!nothing) return fail(nothing.error().message);
    Drawing drawing(stage, terrain, std::move(*nothing));
    drawing.camera = over_the_ground();
    drawing.carve(carves, half_width_m, radius_m, 107);
    Result<std::unique_ptr<DrawMethod>> list = peers::make_csg_list_method(drawing.balls());
    if (!list) return fail(list.error().message);
    drawing.show_by(std::move(*list));
    const Result<double> frame = drawing.frame_ms(width, height, options.quick ? 1 : 5);
    if (!frame) return fail(frame.error().message);
    report.metric(fmt::format("csg_list_{}_carves_frame_ms", carves), *frame);
  }
  return {};
}

}  // namespace

BenchReport run_raymarch_bench(const BenchOptions& options) {
  BenchReport report;
  const Result<std::unique_ptr<Stage>> stage = stage_of(report, view_radius_m);
  Result<void> done;
  if (stage) done = measure_atlas(**stage, options, report);
  // The list draws the noise alone.
  if (stage && done && options.scene == nullptr) done = measure_list(**stage, options, report);
  report.check("draws", stage && done,
               !stage ? stage.error().message
               : done ? (*stage)->renderer->description()
                      : done.error().message);
  return report;
}

}  // namespace scree
