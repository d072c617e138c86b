// A field, a method and a camera without any server, for the drawing benches. Needs no display.
#pragma once

#include <memory>
#include <vector>

#include "bench/support/bench.h"
#include "bench/support/stage.h"
#include "client/render/method_switch.h"
#include "shared/operation/operation.h"
#include "tools/scenes/scene.h"

namespace scree {

/// A terrain that is carved and drawn; pieces vanish as soon as they are cut.
class Drawing {
 public:
  Drawing(Stage& stage, const TerrainSource& terrain, std::unique_ptr<DrawMethod> method);
  /// A scene as it is built, seen from where it says; it is carved about the places of its strikes.
  Drawing(Stage& stage, std::unique_ptr<DrawMethod> method, const SceneSetup& scene);

  /// Number of carved places. More carves fill a place and carve it again, so that the picture stays the same
  /// under any number of edits.
  static constexpr int carved_places = 100;

  /// Carves balls scattered about the origin, each a carve of the world's; the method hears of all as one. In
  /// a scene they lie about its strikes instead, and `half_width_m` is of no account.
  void carve(int carves, float half_width_m, float radius_m, uint64_t random_seed);
  /// Updates until everything is shown; returns the time of the first update, milliseconds.
  double finish();
  /// Time until all changes are shown, milliseconds.
  double shown_after_ms();
  /// Time of a frame until the GPU has finished, milliseconds; the median of `frames`.
  Result<double> frame_ms(int width, int height, int frames);
  Result<Image> picture(int width, int height);
  /// These pieces from now on, where they lie.
  void show(ScenePieces pieces);

  Field& field() { return field_; }
  DrawMethod& method() { return *method_; }
  /// Shows the same field by another method from now on.
  void show_by(std::unique_ptr<DrawMethod> method) { method_ = std::move(method); }
  const std::vector<glm::vec4>& balls() const {
    return balls_;
  }  ///< carved out now: centre and radius, metres

  Camera camera;

 private:
  glm::vec3 place_of_carve(int number, float half_width_m, uint64_t random_seed) const;

  Stage& stage_;
  MapField field_;
  std::vector<glm::vec3> struck_m_{};  ///< places of the scene's strikes
  ScenePieces pieces_;
  std::unique_ptr<DrawMethod> method_;
  std::vector<glm::vec4> balls_;
};

/// The stage of a bench that draws. The condition "gl_renderer" of its report says by which driver, and when
/// that is none of a GPU.
Result<std::unique_ptr<Stage>> stage_of(BenchReport& report, float view_radius_m);

/// Whether the driver of that description (Renderer::description) is software.
bool is_software(const std::string& driver);

/// Pixels that differ in any colour.
size_t differing_pixels(const Image& a, const Image& b);

}  // namespace scree
