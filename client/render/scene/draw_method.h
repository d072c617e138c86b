// The interface of the methods that draw the mirror. A method gets the changes and the scene of each frame,
// and the values of its options; the renderer and the viewer know nothing else of it.
//
// All calls are on the thread that owns the GL context. A frame is: changed() for every message that the
// mirror applied, update() once, then draw() once per pass. One update() shows a consistent state: a merge
// and the removal of its piece appear in the same frame.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>

#include "client/mirror/mirror.h"
#include "client/render/scene/camera.h"
#include "client/render/scene/draw_option.h"
#include "client/render/scene/ground_tint.h"
#include "shared/base/memory_count.h"
#include "shared/prop/prop.h"

namespace scree {

class GpuTimers;

struct ScenePiece {
  std::shared_ptr<const Volume> volume;
  Pose pose;  ///< at the time of the frame
};

using ScenePieces = std::map<PieceId, ScenePiece>;

struct SceneProp {
  std::shared_ptr<const Prop> prop;
  Pose pose;  ///< at the time of the frame: of its origin
};

using SceneProps = std::map<PieceId, SceneProp>;

inline const SceneProps& no_props() {
  static const SceneProps none;
  return none;
}

/// The content of a frame. Methods draw field and pieces; the renderer draws the props, for all methods alike
/// (Renderer::set_props).
struct Scene {
  const Field& field;
  const ScenePieces& pieces;
  const SceneProps& props = no_props();
};

/// The light, which all methods share.
struct Lighting {
  glm::vec3 sun{0.0F, 1.0F, 0.0F};  ///< unit, towards it
  float fog_m = 100.0F;             ///< distance at which the fog hides nearly everything
  glm::mat4 shadow_matrix{1.0F};    ///< from the world to the shadow map's coordinates, 0..1
  unsigned shadow_map = 0;          ///< GL texture of depths, with comparison
  int shadow_samples = 0;           ///< of it for a pixel: 9 or 1; 0: nothing casts a shadow
  bool props_cast = false;          ///< the shadow map has props
  unsigned materials = 0;           ///< GL texture of the palette's looks (client/render/gl/material_table.h)
  unsigned images = 0;              ///< GL texture of their images, a layer each; 0: there are none
  MaterialHeights layers;           ///< heights at which soil and ice cover the ground
  GroundTints tints;                ///< of the ground that looks as it does by itself
};

/// One walk over the scene. For `shadow` only depth counts, and there is no shadow matrix yet.
struct DrawPass {
  enum class Kind { shadow, colour };
  Kind kind = Kind::colour;
  glm::mat4 view_projection{1.0F};
  glm::vec3 eye_m{0.0F};
  Lighting lighting;
  float pixel = 0.001F;         ///< metres that a pixel covers at one metre
  float wind_s = 0.0F;          ///< the wind's time; 0: it is still
  float render_scale = 1.0F;    ///< pixels that are marched, along a side, for one that is shown
  GpuTimers* timers = nullptr;  ///< for a method's own measurements; may be null
};

/// For the HUD and for benches.
struct DrawStats {
  size_t draws = 0;      ///< GL draw calls of the last colour pass
  size_t triangles = 0;  ///< of the last colour pass
  size_t pieces = 0;     ///< shown now
  size_t resident = 0;   ///< blocks of triangles, or bricks, on the GPU
  size_t waiting = 0;    ///< units of work not yet shown
  MemoryCounts memory;
};

class DrawMethod {
 public:
  virtual ~DrawMethod() = default;

  /// Notes changes of the mirror's field and pieces.
  virtual void changed(const MirrorChanges& changes) = 0;
  /// Takes finished work into the picture, and starts new work.
  virtual void update(const Scene& scene, const Camera& camera) = 0;
  /// Whether everything within the view radius is shown, possibly not in its newest state.
  virtual bool loaded() const = 0;
  /// Whether everything within the view radius is shown in its newest state.
  virtual bool complete() const = 0;
  /// Distance up to which the method draws, metres; the fog hides everything beyond.
  virtual float reach_m() const = 0;
  /// Takes the values of its own options, if it has any, for the next draw().
  virtual void set_options(const DrawOptionValues&) {}
  virtual void draw(const DrawPass& pass) = 0;
  virtual DrawStats stats() const = 0;
};

}  // namespace scree
