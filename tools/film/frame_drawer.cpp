#include "tools/film/frame_drawer.h"

#include <chrono>
#include <fmt/format.h>
#include <thread>
#include <utility>

#include "shared/base/timing.h"
#include "tools/film/limits.h"

namespace scree {

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::create(const DrawChoice& drawn,
                                                         const RecordedScene& scene) {
  auto context = TRY(EglContext::create(false));
  auto renderer = TRY(Renderer::create(drawn.view_radius_m));
  Fineness fineness = traits_of(drawn.quality).fineness;
  if (!drawn.details) fineness.details_m = 0.0F;
  renderer->set_fineness(fineness);
  renderer->set_terrain(scene.field().source());
  renderer->set_palette(scene.palette());
  std::unique_ptr<FrameDrawer> drawer(new FrameDrawer(drawn, std::move(context), std::move(renderer)));
  TRY(drawer->methods_.choose(*drawn.method));
  drawer->methods_.set_options(drawn.method_options);
  return drawer;
}

FrameDrawer::FrameDrawer(const DrawChoice& drawn, std::unique_ptr<EglContext> context,
                         std::unique_ptr<Renderer> renderer)
    : drawn_(drawn),
      context_(std::move(context)),
      renderer_(std::move(renderer)),
      pool_(default_worker_threads()),
      methods_(pool_, drawn.view_radius_m, *drawn.method) {}

Result<void> FrameDrawer::prepare(RecordedScene& scene, const MirrorChanges& changes, const Camera& camera,
                                  const Stopped& stopped) {
  const Scene shown = scene.scene();
  TRY(renderer_->set_water(scene.water()));
  TRY(renderer_->set_props(shown.props));
  TRY(methods_.follow(changes, shown, camera));
  if (std::exchange(field_, &shown.field) != &shown.field) renderer_->forget_details();
  TRY(renderer_->follow_details(shown.field, changes.bricks, camera.eye_m));
  const double until_s = steady_now_s() + limits::film_frame_s_max;
  while (!methods_.complete() || !renderer_->details_settled()) {
    if (stopped()) return fail("stopped");
    if (steady_now_s() > until_s)
      return fail(fmt::format("the terrain in view is not ready after {} s (limits.film_frame_s_max)",
                              limits::film_frame_s_max));
    std::this_thread::sleep_for(std::chrono::milliseconds(limits::film_pause_ms));
    TRY(methods_.follow({}, shown, camera));
    TRY(renderer_->follow_details(shown.field, {}, camera.eye_m));
  }
  return {};
}

Result<Image> FrameDrawer::draw(RecordedScene& scene, const MirrorChanges& changes, const Camera& camera,
                                const Stopped& stopped) {
  TRY(prepare(scene, changes, camera, stopped));
  const Scene shown = scene.scene();
  std::vector<Contact> contacts = contacts_of({shown.field, methods_.pieces(), shown.props}, camera.eye_m);
  scene.figures().add_to(contacts);
  renderer_->set_contacts(std::move(contacts));
  renderer_->set_limbs(scene.figures().limbs(camera.eye_m, {}, true));
  renderer_->set_wind_time(scene.seconds());
  if (drawn_.particles) renderer_->set_particles(scene.particles(camera.eye_m));
  LineList lines;
  add_joints(lines, scene.joints(), scene.scene(), camera.eye_m);
  auto image =
      TRY(renderer_->draw_image(*methods_.shown(), camera, drawn_.size.width, drawn_.size.height, lines));
  painter_.paint(image, scene.signs(), scene.sign_moment(), camera);
  return image;
}

}  // namespace scree
