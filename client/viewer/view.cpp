#include "client/viewer/view.h"

#include <utility>

#include "client/render/mesh_method.h"

namespace scree {

Result<std::unique_ptr<View>> View::create(float view_radius_m) {
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(view_radius_m);
  if (!renderer) return fail(renderer.error().message);
  return std::unique_ptr<View>(new View(std::move(*renderer), view_radius_m));
}

View::View(std::unique_ptr<Renderer> renderer, float view_radius_m)
    : view_radius_m_(view_radius_m), renderer_(std::move(renderer)), pool_(default_worker_threads()) {}

View::~View() = default;

Result<void> View::follow(const SessionStep& step, Session& session, const Camera& camera, double now_s) {
  if (step.new_world) {
    Result<std::unique_ptr<DrawMethod>> method = make_mesh_method(pool_, view_radius_m_);
    if (!method) return fail(method.error().message);
    (shown_ ? next_ : shown_) = std::move(*method);
  }
  DrawMethod* current = next_ ? next_.get() : shown_.get();
  if (current == nullptr) return {};
  current->changed(step.changes);
  current->update(Scene{session.mirror()->field(), session.pieces(now_s)}, camera);
  if (next_ && next_->loaded()) shown_ = std::move(next_);
  return {};
}

}  // namespace scree
