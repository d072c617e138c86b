#include "client/render/renderer.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "client/render/gl/gl.h"
#include "client/render/gl/gl_errors.h"
#include "client/render/gl/line_drawer.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/gl/shadow_map.h"
#include "client/render/scene/limits.h"
#include "shared/base/check.h"
#include "shared/field/material.h"

namespace scree {
namespace {

/// Late afternoon, from over the canyon's mouth: the cliff along x = 0 faces it.
const glm::vec3 sun = glm::normalize(glm::vec3(0.72F, 0.62F, 0.42F));

constexpr int image_samples = 4;

/// The far plane, in reaches: beyond the terrain that a method keeps, and the corners of its box.
constexpr float far_per_reach = limits::view_radius_keep * 2.0F;

std::string describe() {
  const auto text = [](GLenum what) {
    const auto* found = reinterpret_cast<const char*>(glGetString(what));
    return std::string(found == nullptr ? "unknown" : found);
  };
  return (epoxy_is_desktop_gl() ? "OpenGL " : "") + text(GL_VERSION) + " (" + text(GL_RENDERER) + ")";
}

Result<void> check_version() {
  const int version = epoxy_gl_version();
  const bool desktop = epoxy_is_desktop_gl();
  if (version >= (desktop ? 33 : 30)) return {};
  return fail("found " + describe() + "; OpenGL 3.3 or OpenGL ES 3.0 is needed: install a newer driver, " +
              "or Mesa's software one (libgl1-mesa-dri) and set LIBGL_ALWAYS_SOFTWARE=1");
}

/// A framebuffer of renderbuffers.
struct Canvas {
  gl::Framebuffer framebuffer;
  gl::Renderbuffer colour;
  gl::Renderbuffer depth;

  Canvas(int width, int height, int samples) {
    glBindRenderbuffer(GL_RENDERBUFFER, colour.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
  }
  bool complete() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
};

/// The target into which an image is drawn, and the one into which its samples are averaged.
struct Canvases {
  int width;
  int height;
  Canvas many;
  Canvas one;

  Canvases(int w, int h, int samples) : width(w), height(h), many(w, h, samples), one(w, h, 0) {}
};

Image read_pixels(int width, int height) {
  std::vector<uint8_t> rgba(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  Image image{width, height, {}};
  image.rgb.reserve(rgba.size() / 4 * 3);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const auto at = (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 4;
      image.rgb.insert(image.rgb.end(), {rgba[at], rgba[at + 1], rgba[at + 2]});
    }
  }
  return image;
}

glm::mat4 projection_of(const Camera& camera, float reach_m, int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return camera.projection(aspect, reach_m * far_per_reach);
}

/// Undoes the projection of a perspective: from 0..1 to metres along the view's axis.
DepthImage read_depths(const glm::mat4& projection, int width, int height) {
  std::vector<float> depths(static_cast<size_t>(width) * static_cast<size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  DepthImage image{width, height, {}};
  image.metres.reserve(depths.size());
  const float scale = projection[2][2], offset = projection[3][2];
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const float depth =
          depths[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
      image.metres.push_back(depth >= 1.0F ? std::numeric_limits<float>::infinity()
                                           : offset / (2.0F * depth - 1.0F + scale));
    }
  }
  return image;
}

}  // namespace

struct Renderer::Parts {
  gl::Program sky;
  LineDrawer lines;
  float view_radius_m;
  MaterialHeights layers{-limits::world_half_height_m, limits::world_half_height_m};
  ShadowMap shadows;
  gl::VertexArray nothing;  ///< core profiles draw with an array bound only
  std::string description;
  gl::ErrorLog errors;
  GpuTimers timers;
  Trace* trace = nullptr;
  float render_scale = 1.0F;
  GridShape grid;
  std::optional<Canvases> canvases;  ///< of the last image

  Parts(gl::Program&& sky_program, LineDrawer&& line_drawer, float radius_m)
      : sky(std::move(sky_program)),
        lines(std::move(line_drawer)),
        view_radius_m(radius_m),
        description(describe()) {}

  /// Canvases of that size.
  Result<void> prepare(int width, int height);

  void draw_shadows(DrawMethod& method, const Camera& camera, DrawPass& pass);
  void draw_sky(const DrawPass& pass) {
    const GpuTimers::Part part(&timers, "sky");
    sky.use();
    sky.set("u_inverse_view_projection", glm::inverse(pass.view_projection));
    sky.set("u_eye", pass.eye_m);
    sky.set("u_sun", sun);
    glDepthFunc(GL_LEQUAL);
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthFunc(GL_LESS);
  }
};

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  parts_->errors.attach();
}

Renderer::~Renderer() {
  parts_->errors.detach();
}

Result<std::unique_ptr<Renderer>> Renderer::create(float view_radius_m) {
  if (const Result<void> version = check_version(); !version) return fail(version.error().message);
  Result<gl::Program> sky = gl::Program::link(
      "sky", std::array{shader_source("sky.vert")},
      std::array{shader_source("atmosphere.glsl"), shader_source("noise.glsl"), shader_source("sky.frag")});
  if (!sky) return fail(sky.error().message);
  Result<LineDrawer> lines = LineDrawer::create();
  if (!lines) return fail(lines.error().message);
  return std::unique_ptr<Renderer>(
      new Renderer(std::make_unique<Parts>(std::move(*sky), std::move(*lines), view_radius_m)));
}

void Renderer::draw(DrawMethod* method, const Camera& camera, unsigned framebuffer, int width, int height,
                    const LineList& lines) {
  if (width <= 0 || height <= 0) return;
  const TraceSpan span(parts_->trace, "viewer", "draw");
  parts_->timers.begin_frame(parts_->trace);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_CULL_FACE);
  if (method != nullptr) method->shape_grid(parts_->grid);
  const float reach_m = method == nullptr ? parts_->view_radius_m : method->reach_m();
  DrawPass pass;
  pass.timers = &parts_->timers;
  pass.render_scale = parts_->render_scale;
  pass.eye_m = camera.eye_m;
  pass.lighting = {sun, reach_m, glm::mat4(1.0F), parts_->shadows.texture(), parts_->layers};
  if (method != nullptr) parts_->draw_shadows(*method, camera, pass);

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  pass.kind = DrawPass::Kind::colour;
  pass.view_projection = projection_of(camera, reach_m, width, height) * camera.view();
  if (method != nullptr) {
    const GpuTimers::Part part(&parts_->timers, "method");
    method->draw(pass);
  }
  parts_->draw_sky(pass);
  parts_->lines.draw(lines, pass.view_projection);
  parts_->errors.poll();
}

void Renderer::Parts::draw_shadows(DrawMethod& method, const Camera& camera, DrawPass& pass) {
  const GpuTimers::Part part(&timers, "shadows");
  pass.kind = DrawPass::Kind::shadow;
  pass.view_projection = shadows.begin(camera, sun, view_radius_m);
  method.draw(pass);
  shadows.end();
  pass.lighting.shadow_matrix = shadows.matrix();
}

Result<void> Renderer::Parts::prepare(int width, int height) {
  if (canvases && canvases->width == width && canvases->height == height) return {};
  canvases.reset();
  GLint largest = 0;
  GLint samples = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  glGetIntegerv(GL_MAX_SAMPLES, &samples);
  if (std::max(width, height) > largest)
    return fail("an image of " + std::to_string(width) + "x" + std::to_string(height) +
                " pixels is over this driver's " + std::to_string(largest) + " a side: use a smaller --size");
  canvases.emplace(width, height, std::min(samples, image_samples));
  if (canvases->many.complete() && canvases->one.complete()) return {};
  canvases.reset();
  return fail("the driver refuses a framebuffer of " + std::to_string(width) + "x" + std::to_string(height) +
              " pixels: use a smaller --size");
}

Result<Image> Renderer::draw_image(DrawMethod& method, const Camera& camera, int width, int height,
                                   const LineList& lines) {
  if (Result<void> ready = parts_->prepare(width, height); !ready) return fail(ready.error().message);
  const Canvases& canvases = *parts_->canvases;
  draw(&method, camera, canvases.many.framebuffer.name(), width, height, lines);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvases.many.framebuffer.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvases.one.framebuffer.name());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, canvases.one.framebuffer.name());
  Image image = read_pixels(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  parts_->errors.poll();
  return image;
}

Result<DepthImage> Renderer::draw_depths(DrawMethod& method, const Camera& camera, int width, int height) {
  if (!epoxy_is_desktop_gl()) return fail("depths cannot be read with OpenGL ES: " + description());
  if (Result<void> ready = parts_->prepare(width, height); !ready) return fail(ready.error().message);
  const unsigned framebuffer = parts_->canvases->one.framebuffer.name();
  draw(&method, camera, framebuffer, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  DepthImage image = read_depths(projection_of(camera, method.reach_m(), width, height), width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  parts_->errors.poll();
  return image;
}

Result<void> Renderer::draw_unseen(DrawMethod& method, const Camera& camera, int width, int height) {
  if (Result<void> ready = parts_->prepare(width, height); !ready) return ready;
  draw(&method, camera, parts_->canvases->many.framebuffer.name(), width, height);
  glFinish();
  return {};
}

const std::vector<GpuTime>& Renderer::gpu_times() const {
  return parts_->timers.latest();
}

void Renderer::set_render_scale(float scale) {
  parts_->render_scale = std::clamp(scale, limits::render_scale_min, limits::render_scale_max);
}

void Renderer::set_grid(const GridShape& shape) {
  CHECK(is_valid(shape));
  parts_->grid = shape;
}

void Renderer::set_trace(Trace* trace) {
  parts_->trace = trace;
}

void Renderer::set_terrain(const TerrainSource& terrain) {
  parts_->layers = layers_of(terrain);
}

const std::string& Renderer::description() const {
  return parts_->description;
}

uint64_t Renderer::gl_errors() const {
  return parts_->errors.count();
}

const std::string& Renderer::first_gl_error() const {
  return parts_->errors.first();
}

}  // namespace scree
