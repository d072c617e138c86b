// The pieces that are shown, as meshes. Needs the GL context current, the destructor too.
#pragma once

#include <optional>
#include <unordered_map>

#include "client/render/gl/gpu_mesh.h"
#include "client/render/gl/surface_program.h"
#include "client/render/pieces/piece_mesh.h"

namespace scree {

class PieceViews {
 public:
  void show(const PieceMesh& piece, float voxel_m);
  void remove(PieceId id);
  /// Moves the meshes to the scene's poses. A piece that is missing in the scene stays at its last pose.
  void move(const ScenePieces& pieces);
  /// Removes the pieces that are not in the scene.
  void erase_all_but(const ScenePieces& pieces);
  bool holds(PieceId id) const { return views_.contains(id); }

  /// With the program in use, whose view projection is set. Adds to the pass's draws and triangles.
  void draw(const SurfaceProgram& program, const Frustum& frustum, float voxel_m, DrawStats& pass) const;

  size_t count() const { return views_.size(); }
  size_t gpu_bytes() const { return gpu_bytes_; }

 private:
  struct View {
    std::optional<GpuMesh> mesh;  ///< none: too small for the grid
    glm::vec3 centre_m;
    float radius_m;
    Pose pose;
  };

  std::unordered_map<PieceId, View> views_;
  size_t gpu_bytes_ = 0;
};

}  // namespace scree
