// The pieces that are shown, as meshes in one buffer, which are one draw. Needs the GL context current, the
// destructor too.
//
// A texture has the place of each (client/shaders/surface.vert), so that no uniform changes between two.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "client/render/gl/mesh_arena.h"
#include "client/render/gl/surface_program.h"
#include "client/render/meshing/piece_mesh.h"

namespace scree {

class PieceViews {
 public:
  void show(const PieceMesh& piece, float voxel_m);
  void remove(PieceId id);
  /// Moves the meshes to the scene's poses. A piece that is missing in the scene stays at its last pose.
  void move(const ScenePieces& pieces);
  /// Shows exactly the scene's pieces where they are now. New ones are meshed at once, which takes time for
  /// each.
  void show_all(const Field& field, const ScenePieces& pieces);

  /// With the program in use, whose view projection is set. Near ones first: what is behind them is not
  /// shaded. Adds to the draws and triangles of `stats`.
  void draw(const SurfaceProgram& program, const DrawPass& pass, float voxel_m, DrawStats& stats);

  unsigned places_texture() const { return places_.name(); }
  size_t count() const { return views_.size(); }
  /// What the pieces that are shown take.
  size_t gpu_bytes() const { return arena_.bytes() + views_.size() * texels_each * sizeof(glm::vec4); }

 private:
  /// Its place and tint, its rotation, its mesh's origin and half its width, its centre.
  static constexpr size_t texels_each = 4;

  struct View {
    MeshArena::Slot slot;  ///< empty: the piece is too small for the grid, or there are too many
    size_t row = 0;        ///< of the texture: its label in the arena
    float reach_m = 0.0F;  ///< from its place to its farthest vertex
    std::shared_ptr<const Volume> volume;
    Pose pose;
  };

  std::optional<size_t> free_row();
  void place(const View& view, PieceId id);
  void upload_places();

  std::unordered_map<PieceId, View> views_;
  MeshArena arena_{true};
  gl::Texture places_;
  std::vector<glm::vec4> texels_;  ///< what places_ shall have
  bool are_new_ = false;           ///< it lacks some of them
  std::vector<size_t> free_rows_;
  std::vector<std::pair<float, const View*>> visible_;  ///< of a draw: squared distances
  std::vector<MeshArena::Slot> slots_;
};

}  // namespace scree
