// Draws the moments of a recording into pictures, without a window. Each picture shows all that is in view,
// in its state of that moment. The GL context is made here, and belongs to the thread that made it.
#pragma once

#include <memory>

#include "client/render/method_switch.h"
#include "client/render/renderer.h"
#include "client/render/scene/quality.h"
#include "client/render/scene/work_pool.h"
#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/pictures/picture_size.h"
#include "client/viewer/signs/sign_painter.h"
#include "tools/film/frame_sink.h"
#include "tools/film/recorded_scene.h"

namespace scree {

struct DrawChoice {
  PictureSize size{};
  const MethodEntry* method = nullptr;  ///< not null
  DrawOptionValues method_options{};
  Quality quality = Quality::high;
  float view_radius_m = 0.0F;
  bool particles = true;
  bool details = true;  ///< grass, bushes and stones, where the quality has them
};

class FrameDrawer {
 public:
  /// For pictures of that scene, or of others of the same terrain and palette. Fails where there is no EGL,
  /// no fit OpenGL, or not what the method needs.
  static Result<std::unique_ptr<FrameDrawer>> create(const DrawChoice& drawn, const RecordedScene& scene);

  /// `changes`: of the scene since the last picture. Waits for the terrain in view; asks meanwhile whether it
  /// shall stop, which is an error.
  Result<Image> draw(RecordedScene& scene, const MirrorChanges& changes, const Camera& camera,
                     const Stopped& stopped);

 private:
  FrameDrawer(const DrawChoice& drawn, std::unique_ptr<EglContext> context,
              std::unique_ptr<Renderer> renderer);
  Result<void> prepare(RecordedScene& scene, const MirrorChanges& changes, const Camera& camera,
                       const Stopped& stopped);

  DrawChoice drawn_;
  std::unique_ptr<EglContext> context_;
  std::unique_ptr<Renderer> renderer_;
  WorkPool pool_;
  MethodSwitch methods_;
  SignPainter painter_;
  const Field* field_ = nullptr;  ///< whose details are drawn
};

}  // namespace scree
