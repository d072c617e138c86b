#include "client/viewer/viewing/viewing.h"

#include <cstdio>
#include <utility>

#include "client/viewer/pictures/picture_difference.h"
#include "client/viewer/pictures/png.h"
#include "client/viewer/session/sight.h"
#include "client/viewer/viewing/auto_quality.h"

namespace scree {
namespace {

float view_radius_of(const ViewerOptions& options, Quality quality) {
  return options.given.view_radius ? options.view_radius_m : traits_of(quality).view_radius_m;
}

}  // namespace

Result<std::unique_ptr<Viewing>> Viewing::begin(const ViewerOptions& options) {
  const Quality quality = options.quality.value_or(options.offscreen ? Quality::high : AutoQuality::first);
  Result<Sounds> sounds = Sounds::begin(options.sound && !options.offscreen, options.sound_file);
  if (!sounds) return fail(sounds.error().message);
  Result<std::unique_ptr<View>> view = View::create(*options.method, view_radius_of(options, quality));
  if (!view) return fail(view.error().message);
  return std::unique_ptr<Viewing>(new Viewing(options, quality, std::move(*view), std::move(*sounds)));
}

Viewing::Viewing(const ViewerOptions& given, Quality quality, std::unique_ptr<View> drawn, Sounds sounds)
    : options(given),
      trace(given.trace_file.empty() ? nullptr : std::make_unique<Trace>()),
      session(given, view_radius_of(given, quality), given.name, given.cache),
      view(std::move(drawn)),
      camera(given.camera),
      screenshots(given.screenshots),
      sounds_(std::move(sounds)),
      particles_(given.particles),
      quality_(quality) {
  view->renderer().set_trace(trace.get());
  use(quality);
  view->renderer().set_grid(options.grid);
  session.watch(given.overlay.shown && given.overlay.physics);
  session.predict(given.predict);
}

void Viewing::use(Quality quality) {
  quality_ = quality;
  Fineness fineness = traits_of(quality).fineness;
  if (options.given.render_scale) fineness.render_scale = options.render_scale;
  view->set_fineness(fineness, view_radius_m());
  session.set_interest_radius(view_radius_m());
}

float Viewing::view_radius_m() const {
  return view_radius_of(options, quality_);
}

Result<void> Viewing::step(double now_s) {
  const SessionStep step = [&] {
    const TraceSpan span(trace.get(), "viewer", "messages");
    return session.step(now_s, camera);
  }();
  if (step.new_mirror) stand_on_ground();
  if (step.new_mirror || step.jumped) {
    watch_.begin();
    dust_.clear();
  }
  if (session.mirror() != nullptr) {
    follow_pieces(now_s);
    view->renderer().set_contacts(
        contacts_of(session.pieces(now_s), session.mirror()->terrain().voxel_size_m, camera.eye_m));
  }
  const TraceSpan span(trace.get(), "viewer", "update");
  if (Result<void> followed = view->follow(step, session, camera, now_s); !followed) return followed;
  return check_gl_errors();
}

/// What they do is heard and seen.
void Viewing::follow_pieces(double now_s) {
  if (sounds_.silent() && !particles_) return;
  const float voxel_m = session.mirror()->terrain().voxel_size_m;
  const std::vector<PieceEvent> events = watch_.step(session.pieces(now_s), voxel_m, now_s);
  sounds_.step(events, camera, now_s);
  if (!particles_) return;
  dust_.add(events, now_s);
  view->renderer().set_particles(dust_.at(now_s, camera.eye_m));
}

void Viewing::show_particles(bool on) {
  if (on == particles_) return;
  particles_ = on;
  dust_.clear();
  view->renderer().set_particles({});
}

/// Where a ground has a middle, and nobody said where to look from, the camera begins above it.
void Viewing::stand_on_ground() {
  if (std::exchange(stands_, true) || options.given.camera) return;
  if (const auto eye_m = spawn_of(session.mirror()->terrain())) camera.eye_m = *eye_m;
}

Result<void> Viewing::check_gl_errors() {
  if (!options.gl_debug || view->renderer().gl_errors() == 0) return {};
  return fail(std::to_string(view->renderer().gl_errors()) +
              " OpenGL errors; the first: " + view->renderer().first_gl_error());
}

Result<void> Viewing::finish() {
  if (Result<void> heard = sounds_.finish(); !heard) return heard;
  return trace ? trace->write(options.trace_file) : Result<void>{};
}

bool Viewing::joined(double now_s) {
  return view->methods().loaded() && session.joined(now_s);
}

Moment Viewing::moment(double now_s) {
  Moment moment;
  moment.now_s = now_s;
  moment.current = view->methods().complete();
  moment.joined = joined(now_s);
  moment.carved = session.carved();
  if (Mirror* mirror = session.mirror()) {
    const Scene scene{session.field(), session.pieces(now_s)};
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    moment.pieces = pieces_in_sight(scene, camera, aspect, view_radius_m());
    const bool elsewhere = mirror->status() && mirror->status()->pieces > 0;
    moment.alive = !mirror->pieces().empty() || elsewhere;
  }
  return moment;
}

Result<Image> Viewing::picture(double now_s, int width, int height) {
  LineList lines;
  if (options.overlay.shown) {
    add_overlay(lines, options.overlay, now_s);
    session.figures(now_s).add_to(lines, camera.eye_m);
  }
  return view->renderer().draw_image(*view->methods().shown(), camera, width, height, lines);
}

void Viewing::add_overlay(LineList& lines, const OverlayChoice& choice, double now_s) {
  session.watch(choice.shown && choice.physics);
  if (!choice.shown || session.mirror() == nullptr) return;
  add_borders(lines, session, choice, camera.eye_m, now_s);
  if (const PhysicsMessage* physics = session.physics())
    add_physics(lines, *physics, session.pieces(now_s), session.mirror()->terrain().voxel_size_m);
}

Result<void> Viewing::take(const ScreenshotOrder& order, double now_s) {
  const Result<Image> image = picture(now_s);
  if (!image) return fail(image.error().message);
  if (Result<void> written = write_png(order.file, *image); !written) return written;
  // Standard output is for figures only.
  std::fprintf(stderr, "wrote %s\n", order.description().c_str());
  if (options.reference.empty()) return {};
  const Result<Image> reference = read_png(options.reference);
  if (!reference) return fail("--reference: " + reference.error().message);
  const Result<double> measured = picture_difference(*image, *reference);
  if (!measured) return fail("--reference: " + measured.error().message);
  difference = *measured;
  return {};
}

Result<void> Viewing::take_due(double now_s) {
  if (screenshots.empty()) return {};
  for (const ScreenshotOrder& order : screenshots.take_due(moment(now_s)))
    if (Result<void> taken = take(order, now_s); !taken) return taken;
  return {};
}

}  // namespace scree
