// A copy of the field on the GPU, for rays and grids: one atlas of bricks, and one texture of entries that
// holds the windows of all levels, which follow the camera. Needs the GL context current.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "client/render/bricks/clip_level.h"
#include "client/render/scene/camera.h"
#include "shared/base/memory_count.h"

namespace scree {

class BrickWorld {
 public:
  static constexpr int looks_unit = 6;
  static constexpr int planes_unit = 8;

  /// `pool` must outlive it.
  BrickWorld(WorkPool& pool, const TerrainSource& source, float view_radius_m, FaceEdges edges);

  /// Uploads these edited bricks, and a bounded number of bricks that are not loaded yet.
  void update(const Field& field, const std::vector<BrickCoord>& changed, glm::vec3 eye_m);

  /// Binds the textures to units 0, 1 and looks_unit and sets the uniforms of client/shaders/bricks.glsl.
  void use(const gl::Program& program, glm::vec3 eye_m) const;

  /// The content of all bricks of a box (metres) on one level: only air, or only rock. Nothing when the box
  /// has a surface, is not loaded, or lies outside the level's window.
  enum class Plain { air, rock };
  std::optional<Plain> plain(glm::vec3 lo_m, glm::vec3 hi_m, int level) const;

  /// Whether nothing in it was edited or has looks of its own.
  bool is_untouched() const;
  BrickAtlas& atlas() { return atlas_; }
  const BrickAtlas& atlas() const { return atlas_; }
  bool loaded() const { return waiting() == 0; }
  size_t waiting() const;
  /// Distance from the camera up to which terrain is drawn at least, metres.
  float reach_m() const;
  float voxel_m() const { return levels_.front().voxel_m(); }
  MemoryCounts memory() const;

 private:
  void upload_entries(ClipLevel& level);

  BrickAtlas atlas_;
  gl::Texture entries_;
  std::deque<ClipLevel> levels_;
  int side_;
};

}  // namespace scree
