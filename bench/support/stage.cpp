#include "bench/support/stage.h"

namespace scree {

Result<std::unique_ptr<Stage>> Stage::create(float view_radius_m) {
  auto stage = std::make_unique<Stage>();
  Result<std::unique_ptr<EglContext>> context = EglContext::create(false);
  if (!context) return fail(context.error().message);
  stage->context = std::move(*context);
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(view_radius_m);
  if (!renderer) return fail(renderer.error().message);
  stage->renderer = std::move(*renderer);
  return stage;
}

}  // namespace scree
