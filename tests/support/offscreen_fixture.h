// Draws without a window, with the driver that EGL finds: Mesa's software driver without a GPU.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>

#include "client/render/method_switch.h"
#include "client/render/renderer.h"
#include "client/viewer/pictures/egl_context.h"
#include "shared/operation/operation.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"

namespace scree {

/// One field, some pieces, and a method that draws them into small images; at first from a little above the
/// origin.
class OffscreenTest : public testing::Test {
 protected:
  static constexpr int width = 160;
  static constexpr int height = 120;

  explicit OffscreenTest(std::string_view method, const TerrainSource& terrain, float radius_m = 12.0F)
      : view_radius_m(radius_m), method_name_(method), field_(terrain) {}

  void SetUp() override {
    Result<std::unique_ptr<EglContext>> context = EglContext::create(true);
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    pin_libraries();
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(view_radius_m);
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer_ = std::move(*renderer);
    method_ = make_method();
    ASSERT_NE(method_, nullptr);
    camera_.eye_m = {0.0F, 3.0F, 6.0F};
    camera_.pitch = -0.45F;
  }
  void TearDown() override {
    if (!renderer_) return;
    EXPECT_EQ(renderer_->gl_errors(), 0U) << renderer_->first_gl_error();
  }

  std::unique_ptr<DrawMethod> make_method() {
    Result<std::unique_ptr<DrawMethod>> method = method_named(method_name_)->make(pool_, view_radius_m);
    EXPECT_TRUE(method) << method.error().message;
    return method ? std::move(*method) : nullptr;
  }

  void finish() { finish(*method_); }
  void finish(DrawMethod& method) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    for (method.update(Scene{field_, pieces_}, camera_); !method.complete();
         method.update(Scene{field_, pieces_}, camera_)) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "not complete in time";
      wait_a_moment();
    }
  }

  Image draw() { return draw(*method_); }
  Image draw(DrawMethod& method) {
    Result<Image> image = renderer_->draw_image(method, camera_, width, height);
    EXPECT_TRUE(image) << image.error().message;
    return image ? *image : Image{};
  }

  /// Carves a ball, or a crater; its pieces hang above the place of the cut.
  void carve(glm::vec3 at_m, ShapeKind kind = ShapeKind::sphere) {
    PieceTable table;
    const Shape shape{kind, at_m, glm::vec3(0.0F), 1.5F};
    const CarveOperation carve{shape, SeedPattern::uniform, 12, 5, at_m, next_piece_};
    const Applied applied = apply(Operation(carve), field_, table);
    MirrorChanges changes;
    changes.bricks = applied.changed;
    next_piece_ += static_cast<PieceId>(applied.created.size());
    for (const CreatedPiece& piece : applied.created) {
      changes.pieces_added.push_back(piece.id);
      const glm::vec3 home = table.at(piece.id)->centre_voxels * field_.source().voxel_size_m;
      pieces_[piece.id] = {table.at(piece.id), Pose{home + glm::vec3(0.0F, 1.5F, 0.0F), {}}};
    }
    method_->changed(changes);
  }

  const float view_radius_m;
  std::string_view method_name_;
  std::unique_ptr<EglContext> context_;
  WorkPool pool_{2};
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<DrawMethod> method_;
  MapField field_;
  ScenePieces pieces_;
  PieceId next_piece_ = 1;
  Camera camera_;
};

/// The number of pixels that differ by more than `tolerance` in any colour.
inline size_t differing_pixels(const Image& a, const Image& b, int tolerance) {
  size_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3) {
    int largest = 0;
    for (size_t c = i; c < i + 3; ++c) largest = std::max(largest, std::abs(a.rgb[c] - b.rgb[c]));
    if (largest > tolerance) ++count;
  }
  return count;
}

}  // namespace scree
