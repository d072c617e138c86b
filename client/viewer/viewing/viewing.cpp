#include "client/viewer/viewing/viewing.h"

#include <cstdio>
#include <utility>

#include "client/cache/join_server.h"
#include "client/viewer/pictures/picture_difference.h"
#include "client/viewer/pictures/png.h"
#include "client/viewer/session/region_lines.h"
#include "client/viewer/session/sight.h"
#include "content/model/glb.h"

namespace scree {
namespace {

/// Nothing: as the quality says.
std::optional<float> radius_of(const ViewerOptions& options) {
  return options.given.view_radius ? std::optional(options.view_radius_m) : std::nullopt;
}

SessionChoice session_of(const ViewerOptions& options, Quality quality) {
  SessionChoice choice;
  choice.interest_radius_m = Visit::interest_radius_m(radius_of(options), quality);
  choice.name = options.name;
  choice.cache = options.cache;
  choice.cache.images = true;
  choice.cache.models = true;
  return choice;
}

VisitChoice visit_of(const ViewerOptions& options, Quality quality) {
  VisitChoice choice;
  choice.quality = quality;
  choice.view_radius_m = radius_of(options);
  if (options.given.render_scale) choice.render_scale = options.render_scale;
  if (options.given.camera) choice.camera = options.camera;
  choice.particles = options.particles;
  choice.details = options.details;
  choice.predict = options.predict;
  return choice;
}

}  // namespace

Result<std::unique_ptr<Viewing>> Viewing::begin(const ViewerOptions& options) {
  const Quality quality = options.quality.value_or(options.offscreen ? Quality::high : AutoQuality::first);
  Result<Sounds> sounds = Sounds::begin(options.sound && !options.offscreen, options.sound_file);
  if (!sounds) return fail(sounds.error().message);
  Result<std::unique_ptr<View>> view = View::create(
      *options.method, radius_of(options).value_or(traits_of(quality).view_radius_m), decode_png, read_glb);
  if (!view) return fail(view.error().message);
  return std::unique_ptr<Viewing>(new Viewing(options, quality, std::move(*view), std::move(*sounds)));
}

Viewing::Viewing(const ViewerOptions& given, Quality quality, std::unique_ptr<View> drawn, Sounds sounds)
    : Visit(std::make_unique<ServerConnector>(given), session_of(given, quality), visit_of(given, quality),
            std::move(drawn), given.trace_file.empty() ? nullptr : std::make_unique<Trace>()),
      options(given),
      screenshots(given.screenshots),
      sounds_(std::move(sounds)) {
  if (!given.given.camera) camera = given.camera;
  listen(!sounds_.silent());
  view->methods().set_options(options.method_options);
  session.want_physics(given.overlay.shown && given.overlay.physics);
}

Result<void> Viewing::step(double now_s) {
  TRY(Visit::step(now_s));
  tell_content_faults();
  if (session.mirror() != nullptr) sounds_.step(events(), camera, now_s);
  return check_gl_errors();
}

void Viewing::play_sound(bool on) {
  sounds_.play_aloud(on);
  listen(!sounds_.silent());
}

/// Each once: what is drawn instead is no reason to stop.
void Viewing::tell_content_faults() {
  for (const std::string& fault : view->models().drain_faults())
    std::fprintf(stderr, "scree-viewer: warning: %s\n", fault.c_str());
  if (session.content_fault() == told_fault_) return;
  told_fault_ = session.content_fault();
  if (!told_fault_.empty()) std::fprintf(stderr, "scree-viewer: warning: %s\n", told_fault_.c_str());
}

Result<void> Viewing::check_gl_errors() {
  if (!options.gl_debug || view->renderer().gl_errors() == 0) return {};
  return fail(std::to_string(view->renderer().gl_errors()) +
              " OpenGL errors; the first: " + view->renderer().first_gl_error());
}

Result<void> Viewing::finish() {
  TRY(sounds_.finish());
  return trace ? trace->write(options.trace_file) : Result<void>{};
}

Moment Viewing::moment(double now_s) {
  Moment moment;
  moment.now_s = now_s;
  moment.current = view->methods().complete() && view->renderer().details_settled() &&
                   view->images_complete() && view->models().complete(session.content_settled());
  moment.joined = joined(now_s);
  moment.carved = session.carved();
  if (Mirror* mirror = session.mirror()) {
    const Scene scene = session.scene(now_s);
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    moment.pieces = pieces_in_sight(scene, camera, aspect, view_radius_m());
    const bool elsewhere = mirror->status() && mirror->status()->pieces > 0;
    moment.alive = !mirror->pieces().empty() || elsewhere;
  }
  return moment;
}

Result<Image> Viewing::picture(double now_s, int width, int height) {
  LineList lines;
  add_joints_of(session, lines, camera.eye_m, now_s);
  if (options.overlay.shown) {
    add_overlay(lines, options.overlay, now_s);
    add_regions_of(session, lines, camera.eye_m);
    session.figures(now_s).add_to(lines);
  }
  // Who only looks on is no part of the world.
  view->renderer().set_limbs(session.figures(now_s).limbs(camera.eye_m, {}, !options.overlay.shown));
  Result<Image> image = view->renderer().draw_image(*view->methods().shown(), camera, width, height, lines);
  if (image && session.mirror() != nullptr)
    painter_.paint(*image, session.mirror()->signs(), sign_moment(now_s), camera);
  return image;
}

Result<void> Viewing::shoot(const ScreenshotOrder& order, double now_s) {
  const Result<Image> image = picture(now_s);
  if (!image) return fail(image.error().message);
  TRY(write_png(order.file, *image));
  // Standard output is for figures only.
  std::fprintf(stderr, "wrote %s\n", order.file.c_str());
  if (options.reference.empty()) return {};
  const Result<Image> reference = read_png(options.reference);
  if (!reference) return fail("--reference: " + reference.error().message);
  const Result<double> measured = picture_difference(*image, *reference);
  if (!measured) return fail("--reference: " + measured.error().message);
  difference = *measured;
  return {};
}

Result<void> Viewing::shoot_due(double now_s) {
  if (screenshots.empty()) return {};
  for (const ScreenshotOrder& order : screenshots.pop_due(moment(now_s))) TRY(shoot(order, now_s));
  return {};
}

}  // namespace scree
