// Every drawing method at every resolution: a frame, the time until an edit is shown, memory. The paper's
// figures 21 and 23, in percent of its 1280 × 720, and full HD; and 16 and 18, by the grid's cells along a
// side.
#include <array>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/drawing.h"
#include "client/render/grid/grid_shape.h"

namespace scree {

namespace {

constexpr float view_radius_m = 96.0F;
constexpr int full_width = 1280;
constexpr int full_height = 720;
constexpr std::array shares_percent{25, 50, 75, 100, 150};
constexpr std::array grid_resolutions{32, 64, 96, 128, 192, 256};
/// Where the blows fall: on the canyon's floor, between the cliff and the arch.
constexpr float carved_half_width_m = 12.0F;
constexpr float carve_radius_m = 2.0F;
constexpr int carves = 40;

/// The target on a datacentre GPU, milliseconds of a frame in full HD.
struct Target {
  std::string_view method;
  double frame_ms;
};
constexpr std::array targets{Target{"raymarch", 1.0}, Target{"mesh", 0.5}};

void check_target(const MethodEntry& entry, double full_hd_ms, const std::string& driver,
                  BenchReport& report) {
  if (is_software(driver)) return;
  for (const Target& target : targets)
    if (target.method == entry.name)
      report.check(fmt::format("{}_full_hd", entry.name), full_hd_ms <= target.frame_ms,
                   fmt::format("{:.2f} ms a frame, wanted at most {:.1f}", full_hd_ms, target.frame_ms));
}

double mebibytes(size_t bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

void report_memory(const MethodEntry& entry, const MemoryCounts& counts, BenchReport& report) {
  size_t cpu_bytes = 0;
  for (const MemoryCount& count : counts) cpu_bytes += count.cpu_bytes;
  report.metric(fmt::format("{}_gpu_mib", entry.name), mebibytes(gpu_bytes_of(counts)));
  report.metric(fmt::format("{}_cpu_mib", entry.name), mebibytes(cpu_bytes));
}

/// At the paper's size, from near the ground, so that the smallest grid reaches it. Points cost no memory but
/// for the blocks of them that are drawn; the field's copy has the rest.
Result<void> measure_grids(Drawing& drawing, bool quick, BenchReport& report) {
  glm::vec3& eye_m = drawing.camera.eye_m;
  eye_m.y = ground_height_m(drawing.field().source(), eye_m.x, eye_m.z) + 1.5F;
  drawing.finish();
  bool shown = true;
  for (const GridSpacing spacing : all_kinds<GridSpacing>)
    for (const int resolution : grid_resolutions) {
      if (quick && resolution > grid_resolutions[1]) break;
      const GridShape shape{resolution, 1, spacing};
      drawing.method().set_options(values_of(shape));
      const Result<double> frame = drawing.frame_ms(full_width, full_height, quick ? 1 : 3);
      if (!frame) return fail(frame.error().message);
      const std::string name = fmt::format("grid_{}_{}_cells", name_of(spacing), resolution);
      const DrawStats stats = drawing.method().stats();
      report.metric(name + "_frame_ms", *frame);
      report.metric(name + "_triangles", static_cast<double>(stats.triangles));
      report.metric(name + "_gpu_mib", mebibytes(gpu_bytes_of(stats.memory)));
      report.metric(name + "_reach_m", static_cast<double>(drawing.method().reach_m()));
      shown = shown && stats.triangles > 0;
    }
  report.check("grids_show_ground", shown, "every grid has triangles");
  return {};
}

/// Measurements of one method's own options, after those that all methods have.
struct OptionSweep {
  std::string_view method;
  Result<void> (*measure)(Drawing& drawing, bool quick, BenchReport& report);
};
constexpr std::array option_sweeps{OptionSweep{"grid", measure_grids}};

/// The scene of the options, or the canyon.
std::unique_ptr<Drawing> drawing_of(Stage& stage, std::unique_ptr<DrawMethod> method,
                                    const SceneSetup* scene) {
  if (scene != nullptr) return std::make_unique<Drawing>(stage, std::move(method), *scene);
  auto drawing =
      std::make_unique<Drawing>(stage, TerrainSource{TerrainKind::canyon, 1, 0.25F}, std::move(method));
  drawing->camera.eye_m = {30.0F, 9.0F, 19.0F};
  drawing->camera.yaw = 1.1F;
  drawing->camera.pitch = -0.12F;
  return drawing;
}

Result<void> measure(Stage& stage, const MethodEntry& entry, const BenchOptions& options,
                     BenchReport& report) {
  const bool quick = options.quick;
  Result<std::unique_ptr<DrawMethod>> method = entry.make(stage.pool, view_radius_m);
  if (!method) return fail(method.error().message);
  const std::unique_ptr<Drawing> made = drawing_of(stage, std::move(*method), options.scene.get());
  Drawing& drawing = *made;
  drawing.finish();
  std::vector<double> update_ms;
  for (int i = 0; i < (quick ? 4 : carves); ++i) {
    drawing.carve(1, carved_half_width_m, carve_radius_m, 30 + static_cast<uint64_t>(i));
    update_ms.push_back(drawing.shown_after_ms());
  }
  report.metric(fmt::format("{}_update_ms", entry.name), quantile(update_ms, 0.5));
  for (const int percent : shares_percent) {
    if (quick && percent > 50) break;
    const int width = full_width * percent / 100, height = full_height * percent / 100;
    const Result<double> frame = drawing.frame_ms(width, height, quick ? 1 : 5);
    if (!frame) return fail(frame.error().message);
    report.metric(fmt::format("{}_{}_percent_frame_ms", entry.name, percent), *frame);
    if (percent == shares_percent.back()) check_target(entry, *frame, stage.renderer->description(), report);
  }
  report_memory(entry, drawing.method().stats().memory, report);
  for (const OptionSweep& sweep : option_sweeps)
    if (sweep.method == entry.name) TRY(sweep.measure(drawing, quick, report));
  return {};
}

}  // namespace

BenchReport run_draw_bench(const BenchOptions& options) {
  BenchReport report;
  const Result<std::unique_ptr<Stage>> stage = stage_of(report, view_radius_m);
  report.check("draws", stage.has_value(), stage ? (*stage)->renderer->description() : stage.error().message);
  if (!stage) return report;
  double done = 0.0;
  for (const MethodEntry& entry : all_methods()) {
    const std::optional<std::string> missing = entry.missing();
    Result<void> measured;
    if (!missing) measured = measure(**stage, entry, options, report);
    report.check(fmt::format("{}_draws", entry.name), !missing && measured,
                 missing    ? "needs " + *missing
                 : measured ? ""
                            : measured.error().message);
    options.progress(++done / static_cast<double>(all_methods().size()));
  }
  return report;
}

}  // namespace scree
