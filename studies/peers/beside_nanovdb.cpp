// Rays through the same terrain: our field and atlas, NanoVDB's grid by its HDDA, and PNanoVDB in GLSL.
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "bench/peers/nano_method.h"
#include "bench/peers/nano_terrain.h"
#include "bench/support/drawing.h"
#include "shared/base/timing.h"
#include "studies/peers/beside.h"

namespace scree {

namespace {

const TerrainSource hills{TerrainKind::noise, 1, 0.25F};
const VoxelBox grid_box{{-256, -128, -256}, {256, 192, 256}};
constexpr float view_radius_m = 64.0F;
constexpr int width = 640, height = 360;
constexpr float carved_half_width_m = 30.0F, carved_radius_m = 1.5F;
constexpr int carves = 100;
constexpr uint64_t edits_a_run = 7;
constexpr int grids_to_warm_up = 7;
constexpr float agreed_voxels = 2.0F;

/// Over the carved ground, across it; in the middle of the grid, so that few rays leave it.
Camera across_the_ground() {
  Camera camera;
  camera.eye_m = {0.0F, 14.0F, 30.0F};
  camera.pitch = -0.4F;
  return camera;
}

/// A ray through the middle of each pixel of a picture.
std::vector<glm::vec3> rays_of(const Camera& camera, int columns, int rows) {
  const glm::mat4 inverse = glm::inverse(
      camera.projection(static_cast<float>(columns) / static_cast<float>(rows), 100.0F) * camera.view());
  std::vector<glm::vec3> rays;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const glm::vec2 at((static_cast<float>(x) + 0.5F) / static_cast<float>(columns),
                         (static_cast<float>(y) + 0.5F) / static_cast<float>(rows));
      const glm::vec4 far = inverse * glm::vec4(at * 2.0F - 1.0F, 0.5F, 1.0F);
      rays.push_back(glm::normalize(glm::vec3(far) / far.w - camera.eye_m));
    }
  return rays;
}

/// Distances by both, in voxels, and how many agree on whether and where the ray ends.
struct Traced {
  double ours_s = 0.0, theirs_s = 0.0;
  double agreed = 0.0;  ///< share of the rays that end at the same surface
};

Traced trace_both(const Field& field, const peers::NanoTerrain& nano, const Camera& camera, bool quick) {
  const std::vector<glm::vec3> rays = quick ? rays_of(camera, 160, 90) : rays_of(camera, width, height);
  const glm::vec3 from = camera.eye_m / field.source().voxel_size_m;
  std::vector<float> ours(rays.size()), theirs(rays.size());
  Traced traced;
  const double begin_s = thread_cpu_s();
  for (size_t i = 0; i < rays.size(); ++i)
    ours[i] = trace(field, from, rays[i], view_radius_m / field.source().voxel_size_m)
                  .value_or(peers::NanoTerrain::none);
  traced.ours_s = thread_cpu_s() - begin_s;
  nano.trace(from, rays, theirs);
  traced.theirs_s = thread_cpu_s() - begin_s - traced.ours_s;
  size_t agreed = 0, judged = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (std::isinf(ours[i])) continue;  // beyond the view: the grid reaches farther
    ++judged;
    if (std::isinf(theirs[i])) continue;
    const float off = sample(field, from + rays[i] * theirs[i]).distance_voxels;
    agreed += std::abs(off) <= agreed_voxels ? 1 : 0;
  }
  traced.agreed = static_cast<double>(agreed) / static_cast<double>(std::max<size_t>(judged, 1));
  return traced;
}

Result<std::unique_ptr<Drawing>> carved_drawing(Stage& stage) {
  Result<std::unique_ptr<DrawMethod>> method = method_named("raymarch")->make(stage.pool, view_radius_m);
  if (!method) return fail(method.error().message);
  auto drawing = std::make_unique<Drawing>(stage, hills, std::move(*method));
  drawing->camera = across_the_ground();
  drawing->carve(carves, carved_half_width_m, carved_radius_m, 7);
  drawing->finish();
  // The driver compiles while it draws for the first times.
  if (const Result<double> warm = drawing->frame_ms(width, height, 2); !warm)
    return fail(warm.error().message);
  return drawing;
}

/// One run: some more carves until each can draw them, rays on the processor, and a frame by each.
Result<void> run_once(Stage& stage, Drawing& ours, uint64_t run, bool quick, PeerFindings& findings) {
  const auto put = [&](const char* name, const char* label, const char* what, double noise_percent,
                       bool more_is_better, double own, double other) {
    Comparison& figure = findings.figure(name, what, noise_percent, more_is_better);
    figure.label = label;
    figure.ours.push_back(own);
    figure.theirs.push_back(other);
  };
  std::optional<peers::NanoTerrain> nano_after;
  std::vector<double> shown_ms, converted_ms;
  const uint64_t edits = quick ? 1 : edits_a_run;
  for (uint64_t i = 0; i < edits; ++i) {
    ours.carve(1, carved_half_width_m, carved_radius_m, 1000 + edits * run + i);
    shown_ms.push_back(ours.shown_after_ms());
    converted_ms.push_back(nano_after.emplace(ours.field(), grid_box).convert_ms());
  }
  const peers::NanoTerrain& nano = *nano_after;
  put("edit_ms", "edit to draw", "a carve of 1.5 m until it can be drawn, ms: atlas against a new grid", 60.0,
      false, quantile(shown_ms, 0.5), quantile(converted_ms, 0.5));
  const Traced traced = trace_both(ours.field(), nano, ours.camera, quick);
  put("million_rays_per_s", "CPU rays", "rays on one thread of the processor, million a second", 15.0, true,
      1e-6 * (quick ? 160.0 * 90.0 : width * height) / traced.ours_s,
      1e-6 * (quick ? 160.0 * 90.0 : width * height) / traced.theirs_s);
  findings.check("rays_agree", traced.agreed >= 0.97,
                 fmt::format("{:.1f} % of NanoVDB's rays end within {:.0f} voxels of Scree's surface, "
                             "wanted 97",
                             100.0 * traced.agreed, agreed_voxels));

  const auto method = peers::make_nano_method(nano.words(), hills.voxel_size_m, view_radius_m);
  if (!method) return fail(method.error().message);
  const int frames = quick ? 1 : 9;
  std::vector<double> ours_ms, theirs_ms;
  for (int i = 0; i <= frames; ++i) {  // in turns
    for (const auto& [each, times_ms] :
         {std::pair(&ours.method(), &ours_ms), std::pair(method->get(), &theirs_ms)}) {
      Stopwatch stopwatch;
      if (auto drawn = stage.renderer->draw_unseen(*each, ours.camera, width, height); !drawn)
        return fail(drawn.error().message);
      if (i > 0) times_ms->push_back(stopwatch.lap_ms());  // the first ones warm up
    }
  }
  put("frame_ms", "frame", "a frame of 640 × 360, ms: whole picture against rays and normals alone", 30.0,
      false, quantile(ours_ms, 0.5), quantile(theirs_ms, 0.5));
  constexpr double mib = 1024.0 * 1024.0;
  put("gpu_mib", "GPU memory", "memory on the GPU, MiB", 5.0, false,
      static_cast<double>(gpu_bytes_of(ours.method().stats().memory)) / mib,
      static_cast<double>(nano.words().size_bytes()) / mib);
  return {};
}

}  // namespace

PeerFindings beside_nanovdb(const PeerOptions& options) {
  PeerFindings findings;
  findings.peer = "NanoVDB " + peers::NanoTerrain::version() + " (OpenVDB 10.0.1)";
  findings.name = "nanovdb";
  const Result<std::unique_ptr<Stage>> stage = Stage::create(view_radius_m);
  if (!stage) {
    findings.missing = "nothing can be drawn here: " + stage.error().message;
    return findings;
  }
  findings.conditions = {
      fmt::format(
          "Hills of 0.25 m voxels with {} balls of 1.5 m carved out, seen across from 14 m height. NanoVDB "
          "has a grid of floats of 128 × 80 × 128 m of them; Scree's field is all of the world.",
          carves),
      "The times on the processor are the processor time of one thread. Scree's `trace()` is sphere tracing "
      "of trilinear samples of a field that can be edited, exact to 0.02 voxel. `ZeroCrossing()` of "
      "NanoVDB's HDDA works with one accessor on a grid that never changes, exact to the voxel.",
      "Frames are drawn by " + (*stage)->renderer->description() +
          ", from start to finish, by the clock. Scree's atlas draws the whole picture, to the horizon: "
          "sun with half shadows, occlusion, sky, material. `PNanoVDB.h` in GLSL draws its grid alone: a "
          "ray by its own `pnanovdb_hdda_zero_crossing`, a normal of six samples, no shadows.",
      fmt::format("After a carve Scree's atlas uploads the bricks that changed. A NanoVDB grid is made anew "
                  "from OpenVDB's: the time is `openToNanoVDB`'s alone, without the CSG and without the "
                  "upload. Both are medians of {} carves.",
                  edits_a_run)};
  Result<std::unique_ptr<Drawing>> drawing = carved_drawing(**stage);
  // The first conversions of a process were seen to take half as long again.
  for (int i = 0; drawing && !options.quick && i < grids_to_warm_up; ++i)
    peers::NanoTerrain((*drawing)->field(), grid_box);
  for (int run = 0; run < options.runs && drawing; ++run) {
    if (const auto ran = run_once(**stage, **drawing, static_cast<uint64_t>(run), options.quick, findings);
        !ran) {
      findings.missing = ran.error().message;
      return findings;
    }
    options.progress(static_cast<double>(run + 1) / options.runs);
  }
  if (!drawing) findings.missing = drawing.error().message;
  return findings;
}

}  // namespace scree
