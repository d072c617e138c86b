#include "client/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "client/render/details/details.h"
#include "client/render/gl/canvas.h"
#include "client/render/gl/contact_drawer.h"
#include "client/render/gl/depth_copy.h"
#include "client/render/gl/gl.h"
#include "client/render/gl/gl_errors.h"
#include "client/render/gl/limb_drawer.h"
#include "client/render/gl/line_drawer.h"
#include "client/render/gl/material_images.h"
#include "client/render/gl/material_table.h"
#include "client/render/gl/particle_drawer.h"
#include "client/render/gl/shadow_map.h"
#include "client/render/gl/sky_drawer.h"
#include "client/render/gl/water_drawer.h"
#include "client/render/pieces/prop_views.h"
#include "client/render/scene/limits.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// Late afternoon, from over the canyon's mouth: the cliff along x = 0 faces it.
const glm::vec3 sun = glm::normalize(glm::vec3(0.72F, 0.62F, 0.42F));

/// The far plane, in reaches: beyond the terrain that a method keeps, and the corners of its box.
constexpr float far_per_reach = limits::view_radius_hysteresis * 2.0F;

glm::mat4 projection_of(const Camera& camera, float reach_m, int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return camera.projection(aspect, reach_m * far_per_reach);
}

/// Instead of a shadow map's: no place lies in the map.
glm::mat4 nowhere_in_shadow() {
  glm::mat4 matrix(0.0F);
  matrix[3] = {2.0F, 2.0F, 0.0F, 1.0F};
  return matrix;
}

}  // namespace

struct Renderer::Parts {
  SkyDrawer sky;
  LineDrawer lines;
  ParticleDrawer particle_drawer;
  std::vector<Particle> particles;
  DepthCopy depths;
  ContactDrawer contact_drawer;
  std::vector<Contact> contacts;
  WaterDrawer water;
  PropViews props;
  LimbDrawer limb_drawer;
  std::vector<Limb> limbs;
  Details details;
  bool draws_details = true;  ///< depths have none
  float wind_s = 0.0F;
  float view_radius_m;
  MaterialHeights layers{-limits::world_half_height_m, limits::world_half_height_m};
  std::shared_ptr<const Palette> palette = plain_palette();
  GroundTints tints;
  MaterialTexelSet come;  ///< images of materials
  MaterialImages images;
  MaterialTable materials{*palette, images};
  Fineness fineness;
  std::optional<ShadowMap> shadows{std::in_place, fineness.shadow_map_side};  ///< nothing: no shadows
  int shadow_age = 0;  ///< frames since the map was drawn; 0: it is to be drawn
  std::string description;
  gl::ErrorLog errors;
  bool asks_for_errors = true;
  GpuTimers timers;
  Trace* trace = nullptr;
  Canvases canvases;   ///< of the last picture, at its own resolution
  Canvases stretched;  ///< of the last image that was stretched

  Parts(SkyDrawer&& of_sky, LineDrawer&& line_drawer, ParticleDrawer&& of_particles,
        ContactDrawer&& of_contacts, LimbDrawer&& of_limbs, float radius_m)
      : sky(std::move(of_sky)),
        lines(std::move(line_drawer)),
        particle_drawer(std::move(of_particles)),
        contact_drawer(std::move(of_contacts)),
        limb_drawer(std::move(of_limbs)),
        view_radius_m(radius_m),
        description(gl::describe_context()) {}

  void show_materials() {
    images.set(*palette, come);
    materials.set(*palette, images);
  }
  /// The pixels that are drawn for a picture of `shown` pixels along a side. Above 1, methods that draw pixel
  /// by pixel do so themselves.
  int drawn(int shown) const {
    const float pixels = static_cast<float>(shown) * std::min(fineness.render_scale, 1.0F);
    return std::max(static_cast<int>(pixels + 0.5F), 1);
  }
  /// The scene at its own resolution, averaged, in canvases.one().
  Result<void> draw_picture(DrawMethod* method, const Camera& camera, int width, int height,
                            const LineList& lines);
  void draw_scene(DrawMethod* method, const Camera& camera, unsigned framebuffer, int width, int height,
                  const LineList& lines);
  void cast_shadows(DrawMethod& method, const Camera& camera, DrawPass& pass);
};

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  parts_->errors.attach();
}

Renderer::~Renderer() {
  parts_->errors.detach();
}

Result<std::unique_ptr<Renderer>> Renderer::create(float view_radius_m) {
  if (const Result<void> version = gl::check_context(); !version) return fail(version.error().message);
  Result<SkyDrawer> sky = SkyDrawer::create();
  if (!sky) return fail(sky.error().message);
  Result<LineDrawer> lines = LineDrawer::create();
  if (!lines) return fail(lines.error().message);
  Result<ParticleDrawer> particles = ParticleDrawer::create();
  if (!particles) return fail(particles.error().message);
  Result<ContactDrawer> contacts = ContactDrawer::create();
  if (!contacts) return fail(contacts.error().message);
  Result<LimbDrawer> limbs = LimbDrawer::create();
  if (!limbs) return fail(limbs.error().message);
  return std::unique_ptr<Renderer>(
      new Renderer(std::make_unique<Parts>(std::move(*sky), std::move(*lines), std::move(*particles),
                                           std::move(*contacts), std::move(*limbs), view_radius_m)));
}

void Renderer::draw(DrawMethod* method, const Camera& camera, unsigned framebuffer, int width, int height,
                    const LineList& lines) {
  if (width <= 0 || height <= 0) return;
  const TraceSpan span(parts_->trace, "viewer", "draw");
  parts_->timers.begin_frame(parts_->trace);
  const bool drawn = parts_->draw_picture(method, camera, width, height, lines).has_value();
  if (drawn) {
    copy_picture(parts_->canvases.one(), parts_->drawn(width), parts_->drawn(height), framebuffer, width,
                 height);
  } else {  // as well as it goes
    parts_->draw_scene(method, camera, framebuffer, width, height, lines);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  if (parts_->asks_for_errors) parts_->errors.poll();
}

Result<void> Renderer::Parts::draw_picture(DrawMethod* method, const Camera& camera, int width, int height,
                                           const LineList& lines) {
  const int drawn_width = drawn(width), drawn_height = drawn(height);
  TRY(canvases.prepare(drawn_width, drawn_height, fineness.samples));
  draw_scene(method, camera, canvases.drawn(), drawn_width, drawn_height, lines);
  canvases.average();
  return {};
}

void Renderer::Parts::draw_scene(DrawMethod* method, const Camera& camera, unsigned framebuffer, int width,
                                 int height, const LineList& line_list) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_CULL_FACE);
  const float reach_m = method == nullptr ? view_radius_m : method->reach_m();
  DrawPass pass;
  pass.timers = &timers;
  pass.render_scale = std::max(fineness.render_scale, 1.0F);
  pass.eye_m = camera.eye_m;
  pass.wind_s = wind_s;
  pass.pixel = 2.0F * std::tan(0.5F * camera.field_of_view) / static_cast<float>(height);
  pass.lighting = {sun,
                   reach_m,
                   nowhere_in_shadow(),
                   shadows ? shadows->texture() : 0,
                   shadows ? fineness.shadow_samples : 0,
                   props.count() > 0 || !limbs.empty() || !details.empty(),
                   materials.texture(),
                   images.texture(),
                   layers,
                   tints};
  if (method != nullptr && shadows) cast_shadows(*method, camera, pass);

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  pass.kind = DrawPass::Kind::colour;
  pass.view_projection = projection_of(camera, reach_m, width, height) * camera.view();
  if (method != nullptr) {
    const GpuTimers::Part part(&timers, "method");
    method->draw(pass);
  }
  if (method != nullptr) {
    const GpuTimers::Part part(&timers, "props");
    props.draw(pass, *palette);
    limb_drawer.draw(limbs, pass);
  }
  if (method != nullptr && draws_details) {
    const GpuTimers::Part part(&timers, "details");
    details.draw(pass);
  }
  const bool with_contacts = fineness.contacts && !contacts.empty(), with_water = water.level_m().has_value();
  // Depths of a framebuffer that is not a canvas may be of a kind that cannot be copied.
  const bool has_depths =
      (with_contacts || with_water) && canvases.ready() && framebuffer == canvases.drawn();
  if (has_depths) depths.take(framebuffer, width, height);
  if (has_depths && with_contacts) {
    const GpuTimers::Part part(&timers, "contacts");
    contact_drawer.draw(contacts, pass, depths);
  }
  {
    const GpuTimers::Part part(&timers, "sky");
    sky.draw(pass);
  }
  if (has_depths && with_water) {
    const GpuTimers::Part part(&timers, "water");
    water.draw(depths, pass);
  }
  {
    const GpuTimers::Part part(&timers, "particles");
    particle_drawer.draw(particles, pass);
  }
  lines.draw(line_list, pass.view_projection);
}

void Renderer::Parts::cast_shadows(DrawMethod& method, const Camera& camera, DrawPass& pass) {
  if (shadow_age == 0) {
    const GpuTimers::Part part(&timers, "shadows");
    pass.kind = DrawPass::Kind::shadow;
    pass.view_projection = shadows->begin(camera, sun, view_radius_m);
    method.draw(pass);
    props.draw(pass, *palette);
    limb_drawer.draw(limbs, pass);
    if (draws_details) details.draw(pass);
    shadows->end();
  }
  pass.lighting.shadow_matrix = shadows->matrix();
  shadow_age = (shadow_age + 1) % fineness.shadow_frames;
}

Result<Image> Renderer::draw_image(DrawMethod& method, const Camera& camera, int width, int height,
                                   const LineList& lines) {
  parts_->shadow_age = 0;
  parts_->timers.begin_frame(parts_->trace);
  if (Result<void> drawn = parts_->draw_picture(&method, camera, width, height, lines); !drawn)
    return fail(drawn.error().message);
  unsigned framebuffer = parts_->canvases.one();
  if (parts_->drawn(width) != width || parts_->drawn(height) != height) {
    if (Result<void> ready = parts_->stretched.prepare(width, height, 0); !ready)
      return fail(ready.error().message);
    copy_picture(framebuffer, parts_->drawn(width), parts_->drawn(height), parts_->stretched.one(), width,
                 height);
    framebuffer = parts_->stretched.one();
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  Image image = read_pixels(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  parts_->errors.poll();
  return image;
}

Result<DepthImage> Renderer::draw_depths(DrawMethod& method, const Camera& camera, int width, int height) {
  if (!epoxy_is_desktop_gl()) return fail("depths cannot be read with OpenGL ES: " + description());
  if (Result<void> ready = parts_->canvases.prepare(width, height, parts_->fineness.samples); !ready)
    return fail(ready.error().message);
  const unsigned framebuffer = parts_->canvases.one();
  parts_->draws_details = false;
  parts_->draw_scene(&method, camera, framebuffer, width, height, {});
  parts_->draws_details = true;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  DepthImage image = read_depths(projection_of(camera, method.reach_m(), width, height), width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  parts_->errors.poll();
  return image;
}

Result<void> Renderer::draw_unseen(DrawMethod& method, const Camera& camera, int width, int height) {
  const TraceSpan span(parts_->trace, "viewer", "draw");
  parts_->timers.begin_frame(parts_->trace);
  TRY(parts_->draw_picture(&method, camera, width, height, {}));
  parts_->errors.poll();
  glFinish();
  return {};
}

void Renderer::set_models(const ModelMeshes& models) {
  parts_->props.set_models(models);
}

Result<void> Renderer::set_props(const SceneProps& props) {
  return parts_->props.show(props);
}

Result<void> Renderer::follow_details(const Field& field, std::span<const BrickCoord> changed,
                                      glm::vec3 eye_m) {
  // Farther, methods draw coarser levels of the ground.
  constexpr float finest_part = 0.45F;
  const float range_m = std::min(parts_->fineness.details_m, finest_part * parts_->view_radius_m);
  return parts_->details.follow(field, changed, eye_m, range_m, sun);
}

void Renderer::set_wind_time(double seconds) {
  constexpr double hour_s = 3600.0;  // a float has parts of a second of it
  parts_->wind_s = static_cast<float>(std::fmod(seconds, hour_s));
}

bool Renderer::details_settled() const {
  return parts_->details.settled();
}

void Renderer::forget_details() {
  parts_->details.forget();
}

void Renderer::set_particles(std::vector<Particle> particles) {
  CHECK(particles.size() <= limits::particles_max);
  parts_->particles = std::move(particles);
}

void Renderer::set_limbs(std::vector<Limb> limbs) {
  parts_->limbs = std::move(limbs);
}

void Renderer::set_contacts(std::vector<Contact> contacts) {
  CHECK(contacts.size() <= limits::contacts_max);
  parts_->contacts = std::move(contacts);
}

Result<void> Renderer::set_water(WaterLevel level_m) {
  parts_->details.set_floor(level_m.value_or(-limits::world_half_height_m));
  return parts_->water.set_level(level_m);
}

const std::vector<GpuTime>& Renderer::gpu_times() const {
  return parts_->timers.latest();
}

void Renderer::set_fineness(const Fineness& fineness) {
  CHECK(fineness.render_scale >= limits::render_scale_min &&
        fineness.render_scale <= limits::render_scale_max);
  CHECK(fineness.shadow_map_side >= 0 && fineness.samples >= 0 && fineness.shadow_frames > 0);
  if (fineness == parts_->fineness) return;
  parts_->fineness = fineness;
  parts_->shadows.reset();
  parts_->shadow_age = 0;
  if (fineness.shadow_map_side > 0) parts_->shadows.emplace(fineness.shadow_map_side);
}

void Renderer::set_view_radius(float metres) {
  parts_->view_radius_m = metres;
}

void Renderer::set_trace(Trace* trace) {
  parts_->trace = trace;
}

void Renderer::set_terrain(const TerrainSource& terrain) {
  parts_->layers = layers_of(terrain);
}

void Renderer::set_palette(const std::shared_ptr<const Palette>& palette) {
  CHECK(palette != nullptr);
  if (parts_->palette == palette) return;
  parts_->palette = palette;
  parts_->tints = ground_tints(*palette);
  parts_->show_materials();
}

void Renderer::set_images(const MaterialTexelSet& images) {
  parts_->come = images;
  parts_->show_materials();
}

const std::string& Renderer::description() const {
  return parts_->description;
}

void Renderer::ask_for_errors_each_time(bool on) {
  parts_->asks_for_errors = on;
}

void Renderer::ask_for_errors() {
  parts_->errors.poll();
}

uint64_t Renderer::gl_errors() const {
  return parts_->errors.count();
}

const std::string& Renderer::first_gl_error() const {
  return parts_->errors.first();
}

}  // namespace scree
