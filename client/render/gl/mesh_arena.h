// Many meshes of surfaces in one buffer of vertices and one of indices, so that those in one frame of
// coordinates are one draw. Needs the GL context current, the destructor too.
//
// Buffers grow by half when they are full, by a copy on the GPU, and keep their size when meshes go.
#pragma once

#include <span>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/scene/ranges.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

class MeshArena {
 public:
  /// A mesh in here.
  struct Slot {
    size_t first_vertex = 0;
    size_t vertices = 0;
    size_t first_index = 0;
    size_t indices = 0;
    size_t triangles() const { return indices / 3; }
  };

  /// With labels, vertices say which mesh they are of (surface.vert's a_piece).
  explicit MeshArena(bool labelled = false) : labelled_(labelled) {}

  /// Not an empty mesh. Its positions will count from `origin`, from which they must fit 16 bits.
  Slot add(const SurfaceMesh& mesh, VoxelCoord origin, uint16_t label = 0);
  void remove(const Slot& slot);
  /// In their order. Returns the number of GL draw calls: one, but one a mesh with OpenGL ES.
  size_t draw(std::span<const Slot> slots);

  /// The bytes of the meshes that are in here.
  size_t bytes() const;

 private:
  /// A buffer, and what of it is taken.
  struct Row {
    GLenum target;  ///< what it is bound as
    gl::Buffer buffer{};
    Ranges ranges{};
    size_t capacity = 0;
  };

  size_t put(Row& row, const void* data, size_t count, size_t bytes_each);

  bool labelled_;
  gl::VertexArray array_;
  Row vertices_{GL_ARRAY_BUFFER};
  Row labels_{GL_ARRAY_BUFFER};  ///< of the vertices, one each, at the same places
  Row indices_{GL_ELEMENT_ARRAY_BUFFER};
  std::vector<GLsizei> counts_;  ///< of the last draw; kept for its memory, as the next
  std::vector<const void*> offsets_;
};

}  // namespace scree
