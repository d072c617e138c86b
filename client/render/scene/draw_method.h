// The seam between the mirror and its many ways to be drawn. A method is fed with what changed and with the
// scene of the frame; nothing else of it is known to the renderer and the viewer.
//
// All on the thread that owns the GL context. A frame is: changed() for every message that the mirror
// applied, update() once, then draw() once per pass. What one update() shows belongs together: a merge and
// the piece's vanishing appear in the same frame.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string_view>

#include "client/mirror/mirror.h"
#include "client/render/scene/camera.h"
#include "client/render/scene/grid_shape.h"
#include "shared/base/memory_count.h"

namespace scree {

class GpuTimers;

struct ScenePiece {
  std::shared_ptr<const Volume> volume;
  Pose pose;  ///< at the time of the frame
};

using ScenePieces = std::map<PieceId, ScenePiece>;

/// All that there is to draw in this frame.
struct Scene {
  Field& field;
  const ScenePieces& pieces;
};

/// The same for all methods, so that they look alike.
struct Lighting {
  glm::vec3 sun{0.0F, 1.0F, 0.0F};  ///< unit, towards it
  float fog_m = 100.0F;             ///< where the fog hides nearly all
  glm::mat4 shadow_matrix{1.0F};    ///< from the world to the shadow map's coordinates, 0..1
  unsigned shadow_map = 0;          ///< GL texture of depths, with comparison
  MaterialHeights layers;           ///< where soil and ice cover the ground
};

/// One walk over the scene. For `shadow` only depth counts, and there is no shadow matrix yet.
struct DrawPass {
  enum class Kind { shadow, colour };
  Kind kind = Kind::colour;
  glm::mat4 view_projection{1.0F};
  glm::vec3 eye_m{0.0F};
  Lighting lighting;
  float render_scale = 1.0F;    ///< pixels that are marched, along a side, for one that is shown
  GpuTimers* timers = nullptr;  ///< for what a method likes to measure of itself; may be null
};

/// For the HUD and for benches.
struct DrawStats {
  size_t draws = 0;      ///< GL draw calls of the last colour pass
  size_t triangles = 0;  ///< of the last colour pass
  size_t pieces = 0;     ///< shown now
  size_t kept = 0;       ///< blocks of triangles, or bricks, on the GPU
  size_t waiting = 0;    ///< units of work not yet shown
  MemoryCounts memory;
};

class DrawMethod {
 public:
  virtual ~DrawMethod() = default;

  virtual std::string_view name() const = 0;
  /// The mirror's field and pieces changed so. Only notes it.
  virtual void changed(const MirrorChanges& changes) = 0;
  /// Shows the work that is done, starts what is needed.
  virtual void update(const Scene& scene, const Camera& camera) = 0;
  /// Whether all within the view radius is shown, if not in its newest state.
  virtual bool loaded() const = 0;
  /// Whether all within the view radius is shown as the field and pieces are now.
  virtual bool complete() const = 0;
  /// How far from the camera it draws; the fog hides what would be beyond. Metres.
  virtual float reach_m() const = 0;
  /// Of methods that draw by a grid: its shape from now on.
  virtual void shape_grid(const GridShape&) {}
  virtual void draw(const DrawPass& pass) = 0;
  virtual DrawStats stats() const = 0;
};

}  // namespace scree
