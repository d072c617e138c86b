// What sharp edges cost, and stones that stay drawn where they merged: beside the same field by the same
// methods with rounded edges and without stones. Both sides take turns, so that they see the same machine.
#include <array>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <unordered_set>

#include "bench/support/benches.h"
#include "bench/support/drawing.h"
#include "bench/support/scenes.h"
#include "client/render/levels/block_windows.h"
#include "client/render/mesh/mesh_method.h"
#include "client/render/meshing/surface_forest.h"
#include "client/render/raymarch/raymarch_method.h"
#include "client/render/scene/look_at.h"
#include "client/render/scene/quality.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "tools/scenes/build.h"

namespace scree {

namespace {

/// Bounds of the times with edges and stones, by the times without.
constexpr double remesh_most = 1.3;
constexpr double rays_most = 1.15;
constexpr double flight_most = 1.10;
/// Measured by software on this machine, at the lowest quality.
constexpr double frames_a_second_least = 10.0;

constexpr int view_width = 1280;
constexpr int view_height = 720;
/// Quantile of times that counts as the time on an idle machine.
constexpr double idle = 0.1;
constexpr float flight_radius_m = 14.0F;
constexpr float shown_radius_m = 32.0F;

double all_threads_ms() {
  return static_cast<double>(std::clock()) * 1000.0 / static_cast<double>(CLOCKS_PER_SEC);
}

/// A ground with what is built and broken on it.
struct Ground {
  std::string_view name;
  SceneSetup setup;
  float strikes_half_width_m;
};

std::array<Ground, 2> grounds() {
  Ground canyon{"canyon", {}, 12.0F};
  canyon.setup.config.terrain = {TerrainKind::canyon, 1, 0.25F};
  canyon.setup.eye_m = {30.0F, 9.0F, 19.0F};
  canyon.setup.target_m = {0.0F, 2.0F, 0.0F};
  Ground street{"street", *scene_named("street")->set_up({}), 8.0F};
  return {std::move(canyon), std::move(street)};
}

/// Strikes whose pieces merged beside their holes: the pieces, and the bricks that changed.
struct Strikes {
  ScenePieces stones;
  std::vector<BrickCoord> changed;
};

Strikes strike(Field& field, float half_width_m, int count) {
  constexpr float scatter_m = 3.0F;
  Strikes made;
  PieceTable pieces;
  PieceId next = 1;
  Random random(11);
  ScatteredBlows blows(field.source(), half_width_m, 2.0F, 32, 5);
  const auto note = [&](const Applied& applied) {
    made.changed.insert(made.changed.end(), applied.changed.begin(), applied.changed.end());
  };
  for (int i = 0; i < count; ++i) {
    const CarveRequest blow = blows.next();
    const Applied cut =
        apply(CarveOperation{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, next},
              field, pieces);
    next += static_cast<PieceId>(cut.created.size());
    note(cut);
    for (const CreatedPiece& created : cut.created) {
      const PieceId id = created.id;
      const glm::vec3 middle_m = pieces.at(id)->centre_voxels * field.source().voxel_size_m;
      const auto off_m = [&] { return (random.unit() * 2.0F - 1.0F) * scatter_m; };
      const float x_m = middle_m.x + off_m(), z_m = middle_m.z + off_m(), turn = random.unit() * 3.0F;
      const glm::vec3 place_m(x_m, ground_height_m(field.source(), x_m, z_m) + 0.2F, z_m);
      const Pose pose{place_m, glm::angleAxis(turn, glm::normalize(glm::vec3(0.3F, 0.8F, 0.5F)))};
      made.stones[id] = {pieces.at(id), dequantise(quantise(pose))};
      note(apply(StampOperation{id, quantise(pose), 0, StampMethod::facets}, field, pieces));
    }
  }
  return made;
}

// ---- Remeshing

/// The blocks of bricks that changed.
std::vector<VoxelBox> blocks_of(const std::vector<BrickCoord>& changed) {
  std::unordered_set<BlockCoord, CoordHash> seen;
  std::vector<VoxelBox> boxes;
  for (const BrickCoord brick : changed) {
    const BlockCoord block{brick.x >> 1, brick.y >> 1, brick.z >> 1};
    if (!seen.insert(block).second) continue;
    const VoxelCoord lo{block.x * block_size, block.y * block_size, block.z * block_size};
    boxes.push_back({lo, lo + VoxelCoord{block_size, block_size, block_size}});
  }
  return boxes;
}

/// Copies blocks out of the field and meshes them, as a change makes a client do.
double remesh_ms(const Field& field, const std::vector<VoxelBox>& boxes, FaceEdges edges, double& mesh_ms,
                 size_t& vertices) {
  const double from_ms = all_threads_ms();
  for (const VoxelBox& box : boxes) {
    const std::optional<BlockWindows> windows = gather_windows(field, box);
    if (!windows) continue;
    const double before_ms = all_threads_ms();
    vertices += windows->mesh(edges).vertices.size();
    mesh_ms += all_threads_ms() - before_ms;
  }
  return all_threads_ms() - from_ms;
}

void measure_remesh(const Ground& ground, bool quick, BenchReport& report) {
  MapField field(ground.setup.config.terrain);
  build_scene(field, ground.setup);
  Strikes strikes = strike(field, ground.strikes_half_width_m, quick ? 4 : 20);
  std::vector<BrickCoord> changed = std::move(strikes.changed);
  // What was built, too: the corners of houses.
  for (int x = -16; x < 16; ++x)
    for (int y = -2; y < 8; ++y)
      for (int z = -16; z < 16; ++z)
        if (field.is_edited({x, y, z})) changed.push_back({x, y, z});
  const std::vector<VoxelBox> boxes = blocks_of(changed);
  std::array<std::vector<double>, 2> whole_ms, mesh_ms;
  std::array<size_t, 2> vertices{};
  for (int round = 0; round < (quick ? 2 : 15); ++round)
    for (const size_t sharp : {size_t{0}, size_t{1}}) {
      double meshing = 0.0;
      vertices[sharp] = 0;
      const FaceEdges edges = sharp == 1 ? FaceEdges::sharp : FaceEdges::rounded;
      whole_ms[sharp].push_back(remesh_ms(field, boxes, edges, meshing, vertices[sharp]));
      mesh_ms[sharp].push_back(meshing);
    }
  const auto name = [&](std::string_view what) { return fmt::format("{}_{}", ground.name, what); };
  const double ratio = quantile(whole_ms[1], idle) / quantile(whole_ms[0], idle);
  const double meshing = quantile(mesh_ms[1], idle) / quantile(mesh_ms[0], idle);
  report.metric(name("blocks"), static_cast<double>(boxes.size()));
  report.metric(name("rounded_block_us"),
                quantile(mesh_ms[0], idle) * 1000.0 / static_cast<double>(boxes.size()));
  report.metric(name("sharp_block_us"),
                quantile(mesh_ms[1], idle) * 1000.0 / static_cast<double>(boxes.size()));
  report.metric(name("remesh_times"), ratio);
  report.metric(name("mesh_times"), meshing);
  report.check(name("meshed"), vertices[0] > 0 && vertices[1] > 0, "both have vertices");
}

// ---- Frames

struct Method {
  std::string_view name;
  Result<std::unique_ptr<DrawMethod>> (*sharp)(WorkPool&, float);
  Result<std::unique_ptr<DrawMethod>> (*rounded)(WorkPool&, float);
};
constexpr std::array methods{Method{"mesh", make_mesh_method, make_rounded_mesh_method},
                             Method{"raymarch", make_raymarch_method, make_rounded_raymarch_method}};

struct Flown {
  std::unique_ptr<Drawing> drawing;
  std::vector<double> clock_ms{};
  std::vector<double> processor_ms{};
};

Result<Flown> prepare(Stage& stage, const Ground& ground, const Method& method, bool sharp, bool stones,
                      float view_radius_m) {
  Result<std::unique_ptr<DrawMethod>> made =
      (sharp ? method.sharp : method.rounded)(stage.pool, view_radius_m);
  if (!made) return fail(made.error().message);
  Flown flown{std::make_unique<Drawing>(stage, std::move(*made), ground.setup)};
  Strikes strikes = strike(flown.drawing->field(), ground.strikes_half_width_m, 10);
  if (stones) flown.drawing->show(std::move(strikes.stones));
  return flown;
}

/// From a carve to its picture by the mesh: copies, meshes, uploads, in processor time of all threads.
Result<void> measure_shown(Stage& stage, const Ground& ground, bool quick, BenchReport& report) {
  std::array<Flown, 2> sides;
  for (const size_t i : {size_t{0}, size_t{1}}) {
    Result<Flown> flown = prepare(stage, ground, methods[0], i == 1, false, shown_radius_m);
    if (!flown) return fail(flown.error().message);
    sides[i] = std::move(*flown);
    sides[i].drawing->finish();
  }
  for (int i = 0; i < (quick ? 3 : 40); ++i)
    for (Flown& side : sides) {
      side.drawing->carve(1, ground.strikes_half_width_m, 2.0F, 100 + static_cast<uint64_t>(i));
      const double before_ms = all_threads_ms();
      side.drawing->finish();
      side.processor_ms.push_back(all_threads_ms() - before_ms);
    }
  const double ratio = quantile(sides[1].processor_ms, 0.5) / quantile(sides[0].processor_ms, 0.5);
  report.metric(fmt::format("{}_carve_to_picture_ms", ground.name), quantile(sides[1].processor_ms, 0.5));
  report.metric(fmt::format("{}_carve_to_picture_times", ground.name), ratio);
  report.check(fmt::format("{}_carve_to_picture", ground.name), ratio <= remesh_most,
               fmt::format("{:.2f} times the processor time without edges, wanted at most {:.1f}", ratio,
                           remesh_most));
  return {};
}

/// Around the middle, at the height of the scene's eye.
Camera camera_at(const Ground& ground, double share) {
  const auto turn = static_cast<float>(share * 2.0 * std::numbers::pi);
  const glm::vec3 from(std::sin(turn) * flight_radius_m, 6.0F, 4.0F + std::cos(turn) * flight_radius_m);
  const float ground_m = ground_height_m(ground.setup.config.terrain, from.x, from.z);
  return look_at(from + glm::vec3(0.0F, std::max(ground_m, 0.0F), 0.0F), {0.0F, 1.0F, 0.0F});
}

/// The frames of a flight, by both sides in turn.
Result<void> fly(Stage& stage, const Ground& ground, int frames, std::array<Flown, 2>& sides) {
  for (int i = 0; i < frames; ++i)
    for (Flown& side : sides) {
      side.drawing->camera = camera_at(ground, static_cast<double>(i) / frames);
      side.drawing->finish();
      const double before_ms = all_threads_ms();
      Stopwatch stopwatch;
      TRY(stage.renderer->draw_unseen(side.drawing->method(), side.drawing->camera, view_width, view_height));
      side.clock_ms.push_back(stopwatch.lap_ms());
      side.processor_ms.push_back(all_threads_ms() - before_ms);
    }
  return {};
}

double sum_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

Result<void> measure_flight(Stage& stage, const Ground& ground, const Method& method, Quality quality,
                            bool quick, BenchReport& report) {
  const QualityRow& traits = traits_of(quality);
  stage.renderer->set_fineness(traits.fineness);
  stage.renderer->set_view_radius(traits.view_radius_m);
  std::array<Flown, 2> sides;
  for (const size_t i : {size_t{0}, size_t{1}}) {
    Result<Flown> flown = prepare(stage, ground, method, i == 1, i == 1, traits.view_radius_m);
    if (!flown) return fail(flown.error().message);
    sides[i] = std::move(*flown);
  }
  TRY(fly(stage, ground, 1, sides));  // warms up
  for (Flown& side : sides) {
    side.clock_ms.clear();
    side.processor_ms.clear();
  }
  TRY(fly(stage, ground, quick ? 2 : 16, sides));
  const auto name = [&](std::string_view what) {
    return fmt::format("{}_{}_{}_{}", ground.name, method.name, name_of(quality), what);
  };
  const double ratio = sum_of(sides[1].processor_ms) / sum_of(sides[0].processor_ms);
  const double frame_ms = quantile(sides[1].clock_ms, 0.5);
  report.metric(name("plain_frame_ms"), quantile(sides[0].clock_ms, 0.5));
  report.metric(name("frame_ms"), frame_ms);
  report.metric(name("processor_times"), ratio);
  report.check(name("flight"), ratio <= flight_most,
               fmt::format("{:.3f} times the processor time without edges and stones, wanted at most {:.2f}",
                           ratio, flight_most));
  if (quality == Quality::low)
    report.check(
        name("pace"), frame_ms <= 1000.0 / frames_a_second_least,
        fmt::format("{:.0f} ms a frame, wanted at most {:.0f}", frame_ms, 1000.0 / frames_a_second_least));
  return {};
}

/// Rays alone, full size, without stones.
Result<void> measure_rays(Stage& stage, const Ground& ground, bool quick, BenchReport& report) {
  stage.renderer->set_fineness(traits_of(Quality::high).fineness);
  std::array<Flown, 2> sides;
  for (const size_t i : {size_t{0}, size_t{1}}) {
    Result<Flown> flown =
        prepare(stage, ground, methods[1], i == 1, false, traits_of(Quality::high).view_radius_m);
    if (!flown) return fail(flown.error().message);
    sides[i] = std::move(*flown);
  }
  for (int round = 0; round < (quick ? 1 : 2); ++round) TRY(fly(stage, ground, quick ? 2 : 8, sides));
  const double ratio = sum_of(sides[1].processor_ms) / sum_of(sides[0].processor_ms);
  report.metric(fmt::format("{}_rays_frame_ms", ground.name), quantile(sides[1].clock_ms, 0.5));
  report.metric(fmt::format("{}_rays_times", ground.name), ratio);
  report.check(
      fmt::format("{}_rays", ground.name), ratio <= rays_most,
      fmt::format("{:.3f} times the processor time without edges, wanted at most {:.2f}", ratio, rays_most));
  return {};
}

Result<void> measure_frames(Stage& stage, const BenchOptions& options, BenchReport& report) {
  for (const Ground& ground : grounds()) {
    if (options.part.empty() || options.part == "remesh")
      TRY(measure_shown(stage, ground, options.quick, report));
    if (options.part.empty() || options.part == "rays")
      TRY(measure_rays(stage, ground, options.quick, report));
    if (!options.part.empty() && options.part != "flight") continue;
    for (const Method& method : methods)
      for (const Quality quality : all_kinds<Quality>)
        TRY(measure_flight(stage, ground, method, quality, options.quick, report));
  }
  return {};
}

}  // namespace

BenchReport run_edges_bench(const BenchOptions& options) {
  BenchReport report;
  if (options.part.empty() || options.part == "remesh")
    for (const Ground& ground : grounds()) measure_remesh(ground, options.quick, report);
  options.progress(0.2);
  const Result<std::unique_ptr<Stage>> stage = stage_of(report, traits_of(Quality::high).view_radius_m);
  Result<void> done;
  if (stage) done = measure_frames(**stage, options, report);
  report.check("draws", stage && done,
               !stage ? stage.error().message
               : done ? (*stage)->renderer->description()
                      : done.error().message);
  return report;
}

}  // namespace scree
