// What a frame of the raymarcher costs as carves add up, beside the paper's list of carves; and whether its
// picture is that of an atlas built afresh from the same field.
#include <fmt/format.h>

#include "bench/benches.h"
#include "bench/drawing.h"
#include "bench/peers_csg_list.h"

namespace scree {

namespace {

constexpr float view_radius_m = 96.0F;
constexpr int width = 640;
constexpr int height = 360;
constexpr float half_width_m = 40.0F;
constexpr float radius_m = 1.5F;

/// From over the carved ground, across it.
Camera over_the_ground() {
  Camera camera;
  camera.eye_m = {0.0F, 16.0F, 46.0F};
  camera.pitch = -0.38F;
  return camera;
}

Result<void> measure_atlas(Stage& stage, const BenchOptions& options, BenchReport& report) {
  const int frames = options.quick ? 3 : 15;
  Result<std::unique_ptr<DrawMethod>> method = method_named("raymarch")->make(stage.pool, view_radius_m);
  if (!method) return fail(method.error().message);
  Drawing drawing(stage, {TerrainKind::noise, 1, 0.25F}, std::move(*method));
  drawing.camera = over_the_ground();
  drawing.finish();
  std::vector<double> frame_ms;
  int carved = 0;
  for (const int carves : {0, 100, 1000, 10000}) {
    if (options.quick && carves > 1000) break;
    drawing.carve(carves - carved, half_width_m, radius_m, 7 + static_cast<uint64_t>(carves));
    const double update_ms = drawing.finish();
    if (carves > 0) report.metric(fmt::format("atlas_update_{}_carves_ms", carves - carved), update_ms);
    carved = carves;
    const Result<double> frame = drawing.frame_ms(width, height, frames);
    if (!frame) return fail(frame.error().message);
    frame_ms.push_back(*frame);
    report.metric(fmt::format("atlas_{}_carves_frame_ms", carves), *frame);
    options.progress(0.1 + 0.2 * static_cast<double>(frame_ms.size()));
  }
  const double growth = frame_ms.back() / frame_ms.front();
  report.metric("atlas_last_over_first", growth);
  report.check(
      "atlas_flat", growth <= 1.10,
      fmt::format("{:.3f} times the first frame after {} carves, wanted at most 1.10", growth, carved));
  const Result<Image> lived = drawing.picture(width, height);
  Result<std::unique_ptr<DrawMethod>> fresh = method_named("raymarch")->make(stage.pool, view_radius_m);
  if (!fresh) return fail(fresh.error().message);
  drawing.take(std::move(*fresh));
  drawing.finish();
  const Result<Image> afresh = drawing.picture(width, height);
  if (!lived || !afresh) return fail((!lived ? lived : afresh).error().message);
  const size_t differing = differing_pixels(*lived, *afresh);
  report.check("pixels_of_a_fresh_atlas", differing == 0,
               fmt::format("{} pixels differ, wanted none", differing));
  report.metric("atlas_mib",
                static_cast<double>(gpu_bytes_of(drawing.method().stats().memory)) / (1024.0 * 1024.0));
  return {};
}

Result<void> measure_list(Stage& stage, const BenchOptions& options, BenchReport& report) {
  const TerrainSource terrain{TerrainKind::noise, 1, 0.25F};
  for (const int carves : {0, 10, 100}) {
    Result<std::unique_ptr<DrawMethod>> nothing = peers::make_csg_list_method({});
    if (!nothing) return fail(nothing.error().message);
    Drawing drawing(stage, terrain, std::move(*nothing));
    drawing.camera = over_the_ground();
    drawing.carve(carves, half_width_m, radius_m, 107);
    Result<std::unique_ptr<DrawMethod>> list = peers::make_csg_list_method(drawing.balls());
    if (!list) return fail(list.error().message);
    drawing.take(std::move(*list));
    const Result<double> frame = drawing.frame_ms(width, height, options.quick ? 1 : 5);
    if (!frame) return fail(frame.error().message);
    report.metric(fmt::format("csg_list_{}_carves_frame_ms", carves), *frame);
  }
  return {};
}

}  // namespace

BenchReport run_raymarch_bench(const BenchOptions& options) {
  BenchReport report;
  const Result<std::unique_ptr<Stage>> stage = Stage::create(view_radius_m);
  Result<void> done;
  if (stage) done = measure_atlas(**stage, options, report);
  if (stage && done) done = measure_list(**stage, options, report);
  report.check("draws", stage && done,
               !stage ? stage.error().message
               : done ? (*stage)->renderer->description()
                      : done.error().message);
  return report;
}

}  // namespace scree
