// Draws a frame: shadows, the method's terrain and pieces, props, the sky. Needs the GL context current, the
// destructor too.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "client/render/gl/gpu_timers.h"
#include "client/render/image.h"
#include "client/render/scene/contact.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/limb.h"
#include "client/render/scene/line_list.h"
#include "client/render/scene/material_texels.h"
#include "client/render/scene/particle.h"
#include "client/render/scene/quality.h"
#include "shared/base/water.h"
#include "shared/material/palette.h"
#include "shared/prop/model_mesh.h"

namespace scree {

class Renderer {
 public:
  /// Fails without OpenGL 3.3 or OpenGL ES 3.0; the error names the version found.
  static Result<std::unique_ptr<Renderer>> create(float view_radius_m);
  ~Renderer();

  /// Sets the terrain, which decides where soil and ice cover the ground. Before the first call, all is rock.
  void set_terrain(const TerrainSource& terrain);
  /// What materials look like from now on; before the first call, as rows of plain_palette(). Not null. Costs
  /// nothing where the palette is the one that was set.
  void set_palette(const std::shared_ptr<const Palette>& palette);
  /// The images of palettes that have come, from now on. A row whose image is missing shows its colour.
  void set_images(const MaterialTexelSet& images);

  /// The models of props that have come, from now on. A prop whose model is not among them shows its parts.
  void set_models(const ModelMeshes& models);

  /// The props that are drawn from now on, with every method, where they are now. The cost grows with their
  /// number, and with that of new shapes. Fails if the driver cannot make what draws them.
  Result<void> set_props(const SceneProps& props);

  /// Grass, bushes and stones on this field's ground about that place, from now on, as far as fineness has
  /// any; `changed`: its bricks since the last call. Some work of each frame. Fails if the driver cannot make
  /// what draws them.
  Result<void> follow_details(const Field& field, std::span<const BrickCoord> changed, glm::vec3 eye_m);
  /// The time by which wind bends plants from now on, seconds; 0, as at first: nothing moves.
  void set_wind_time(double seconds);
  /// Whether all of them within their range are there.
  bool details_settled() const;
  /// Another world's ground follows.
  void forget_details();

  /// Into the GL framebuffer of that name (0: the window's). A size of nothing draws nothing; without a
  /// method there is only sky. `lines` come last.
  void draw(DrawMethod* method, const Camera& camera, unsigned framebuffer, int width, int height,
            const LineList& lines = {});

  /// What is in the air from now on, in pictures alone: depths have none of it. The farthest first, at most
  /// limits::particles_max.
  void set_particles(std::vector<Particle> particles);

  /// The bodies of persons, which cast shadows, from now on.
  void set_limbs(std::vector<Limb> limbs);

  /// Where pieces and props darken what they lie on from now on, where fineness has that.
  void set_contacts(std::vector<Contact> contacts);

  /// The water's surface from now on, in pictures alone; nothing: none. The first one fails where its shader
  /// does.
  Result<void> set_water(WaterLevel level_m);

  /// Draws into an image of its own. Fails if the driver cannot make one so large.
  Result<Image> draw_image(DrawMethod& method, const Camera& camera, int width, int height,
                           const LineList& lines = {});
  /// The depth buffer after draw(), one sample in the middle of each pixel. Fails like draw_image(), and on
  /// OpenGL ES, which cannot read depths.
  Result<DepthImage> draw_depths(DrawMethod& method, const Camera& camera, int width, int height);
  /// Draws without returning an image: returns when the GPU has finished. For measurements.
  Result<void> draw_unseen(DrawMethod& method, const Camera& camera, int width, int height);

  /// "OpenGL 4.5 (llvmpipe …)", for people.
  const std::string& description() const;
  /// The GPU's times for the parts of a frame, some frames ago; empty where the driver cannot measure them.
  const std::vector<GpuTime>& gpu_times() const;
  /// How finely it draws from now on; the depths of draw_depths() have one sample for each pixel all the
  /// same. A scale within limits::render_scale_min … max, above 1 for methods that draw pixel by pixel alone.
  void set_fineness(const Fineness& fineness);
  /// The distance about the camera in which shadows are cast, as far as the map reaches.
  void set_view_radius(float metres);
  /// From now on, drawing is traced; null: no more. Must outlive the renderer or be taken away.
  void set_trace(Trace* trace);
  /// Whether each draw() asks GL for errors, as it does unless told otherwise. Asking waits for the GPU where
  /// its commands go through another process, as in a browser; ask_for_errors() does it when somebody wants
  /// to know.
  void ask_for_errors_each_time(bool on);
  void ask_for_errors();
  /// Errors that GL reported since the start (by its debug output, where the context has one), and the first.
  uint64_t gl_errors() const;
  const std::string& first_gl_error() const;

 private:
  struct Parts;
  explicit Renderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace scree
