// A SurfaceMesh in the GPU's memory. Needs the GL context current, the destructor too.
#pragma once

#include "client/render/gl/gl.h"
#include "shared/surface/surface_nets.h"

namespace scree {

class GpuMesh {
 public:
  /// Not of an empty mesh.
  explicit GpuMesh(const SurfaceMesh& mesh);

  void draw() const;
  size_t triangles() const { return static_cast<size_t>(index_count_) / 3; }
  size_t bytes() const { return bytes_; }
  VoxelCoord origin() const { return origin_; }

 private:
  gl::VertexArray array_;
  gl::Buffer vertices_;
  gl::Buffer indices_;
  VoxelCoord origin_;
  GLsizei index_count_;
  GLenum index_type_;
  size_t bytes_;
};

}  // namespace scree
