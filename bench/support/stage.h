// Drawing without a window, for benches and pictures. Needs no display; the GL context is made here, and
// belongs to the thread that made it.
#pragma once

#include <memory>

#include "client/render/renderer.h"
#include "client/render/scene/work_pool.h"
#include "client/viewer/pictures/egl_context.h"

namespace scree {

/// The GL context that every drawing of a bench shares.
struct Stage {
  std::unique_ptr<EglContext> context;
  std::unique_ptr<Renderer> renderer;
  WorkPool pool{default_worker_threads()};

  /// Fails where there is no EGL or no fit OpenGL, saying so.
  static Result<std::unique_ptr<Stage>> create(float view_radius_m);
};

}  // namespace scree
