#include "client/viewer/session/view.h"

#include <utility>

namespace scree {

Result<std::unique_ptr<View>> View::create(const MethodEntry& method, float view_radius_m, DecodeImage decode,
                                           DecodeModel decode_model) {
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(view_radius_m);
  if (!renderer) return fail(renderer.error().message);
  std::unique_ptr<View> view(new View(std::move(*renderer), method, view_radius_m, decode, decode_model));
  if (Result<void> chosen = view->methods_.choose(method); !chosen) return fail(chosen.error().message);
  return view;
}

View::View(std::unique_ptr<Renderer> renderer, const MethodEntry& method, float view_radius_m,
           DecodeImage decode, DecodeModel decode_model)
    : renderer_(std::move(renderer)),
      pool_(default_worker_threads()),
      methods_(pool_, view_radius_m, method),
      images_(pool_, decode),
      models_(pool_, decode_model) {}

View::~View() = default;

void View::set_fineness(const Fineness& fineness, float view_radius_m) {
  renderer_->set_fineness(fineness);
  renderer_->set_view_radius(view_radius_m);
  methods_.set_view_radius(view_radius_m);
}

Result<void> View::follow(const SessionStep& step, ViewerSession& session, const Camera& camera,
                          double now_s) {
  if (step.new_mirror) {
    if (step.other_world) methods_.forget_world();
    methods_.begin_world();
    renderer_->forget_details();
    renderer_->set_terrain(session.mirror()->terrain());
  }
  if (step.jumped) methods_.forget_stones();
  if (session.mirror() == nullptr) return {};
  const std::shared_ptr<const Palette>& palette = session.mirror()->palette();
  renderer_->set_palette(palette);
  if (images_.follow(*palette, [&](const Digest& image) { return session.content(image); }))
    renderer_->set_images(images_.texels());
  const Scene scene = session.scene(now_s);
  if (models_.follow(scene.props, [&](const Digest& model) { return session.model(model); }))
    renderer_->set_models(models_.meshes());
  TRY(renderer_->set_water(session.water()));
  TRY(renderer_->set_props(scene.props));
  TRY(methods_.follow(step.changes, scene, camera));
  // Afterwards: they stand on the ground that the method has generated.
  return renderer_->follow_details(scene.field, step.changes.bricks, camera.eye_m);
}

}  // namespace scree
