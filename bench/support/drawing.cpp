#include "bench/support/drawing.h"

#include <thread>

#include "client/render/scene/look_at.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "tools/scenes/build.h"

namespace scree {

Drawing::Drawing(Stage& stage, const TerrainSource& terrain, std::unique_ptr<DrawMethod> method)
    : stage_(stage), field_(terrain), method_(std::move(method)) {}

Drawing::Drawing(Stage& stage, std::unique_ptr<DrawMethod> method, const SceneSetup& scene)
    : Drawing(stage, scene.config.terrain, std::move(method)) {
  build_scene(field_, scene);
  camera = look_at(scene.eye_m, scene.target_m);
  for (const CarveRequest& strike : scene.strikes) struck_m_.push_back(centre_of(strike.shape));
}

glm::vec3 Drawing::place_of_carve(int number, float half_width_m, uint64_t random_seed) const {
  constexpr float about_m = 2.5F;  // the strikes
  Random random(random_seed + static_cast<uint64_t>(number));
  const auto place = [&](float reach_m) { return (random.unit() * 2.0F - 1.0F) * reach_m; };
  if (!struck_m_.empty()) {
    const float x_m = place(about_m), y_m = place(about_m), z_m = place(about_m);
    return struck_m_[static_cast<size_t>(number) % struck_m_.size()] + glm::vec3(x_m, y_m, z_m);
  }
  const float x_m = place(half_width_m), z_m = place(half_width_m);
  return {x_m, ground_height_m(field_.source(), x_m, z_m), z_m};
}

void Drawing::carve(int carves, float half_width_m, float radius_m, uint64_t random_seed) {
  MirrorChanges changes;
  PieceTable pieces;
  const auto note = [&](const Applied& applied) {
    changes.bricks.insert(changes.bricks.end(), applied.changed.begin(), applied.changed.end());
  };
  for (int i = 0; i < carves; ++i) {
    const glm::vec3 centre = place_of_carve(i % carved_places, half_width_m, random_seed);
    const Shape ball = sphere(centre, radius_m);
    if (i >= carved_places) note(apply(FillOperation{ball}, field_, pieces));
    note(apply(CarveOperation{ball, SeedPattern::uniform, 1, 1, centre, 1}, field_, pieces));
    pieces.clear();
    if (i < carved_places) balls_.emplace_back(centre, radius_m);
  }
  method_->changed(changes);
}

double Drawing::finish() {
  const Scene scene{field_, pieces_};
  Stopwatch stopwatch;
  method_->update(scene, camera);
  const double first_ms = stopwatch.lap_ms();
  while (!method_->complete()) {
    std::this_thread::yield();
    method_->update(scene, camera);
  }
  return first_ms;
}

double Drawing::shown_after_ms() {
  Stopwatch stopwatch;
  finish();
  return stopwatch.lap_ms();
}

Result<double> Drawing::frame_ms(int width, int height, int frames) {
  std::vector<double> times_ms;
  // The first one warms up.
  for (int i = 0; i <= frames; ++i) {
    Stopwatch stopwatch;
    if (Result<void> drawn = stage_.renderer->draw_unseen(*method_, camera, width, height); !drawn)
      return fail(drawn.error().message);
    if (i > 0) times_ms.push_back(stopwatch.lap_ms());
  }
  return quantile(times_ms, 0.5);
}

Result<Image> Drawing::picture(int width, int height) {
  return stage_.renderer->draw_image(*method_, camera, width, height);
}

void Drawing::show(ScenePieces pieces) {
  MirrorChanges changes;
  for (const auto& [id, piece] : pieces_) changes.pieces_removed.push_back(id);
  for (const auto& [id, piece] : pieces) changes.pieces_added.push_back(id);
  pieces_ = std::move(pieces);
  method_->changed(changes);
}

Result<std::unique_ptr<Stage>> stage_of(BenchReport& report, float view_radius_m) {
  Result<std::unique_ptr<Stage>> stage = Stage::create(view_radius_m);
  std::string driver = stage ? (*stage)->renderer->description() : "none: " + stage.error().message;
  if (stage && is_software(driver)) driver += ", software: no GPU was reached";
  report.condition("gl_renderer", driver);
  return stage;
}

bool is_software(const std::string& driver) {
  return driver.find("llvmpipe") != std::string::npos || driver.find("softpipe") != std::string::npos;
}

size_t differing_pixels(const Image& a, const Image& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3)
    if (a.rgb[i] != b.rgb[i] || a.rgb[i + 1] != b.rgb[i + 1] || a.rgb[i + 2] != b.rgb[i + 2]) ++count;
  return count;
}

}  // namespace scree
