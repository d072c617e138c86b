#include "client/render/gl/gpu_mesh.h"

#include <vector>

#include "client/render/gl/surface_vertices.h"
#include "shared/base/check.h"

namespace scree {
namespace {

template <typename T>
void upload(GLenum target, const std::vector<T>& data) {
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
}

}  // namespace

GpuMesh::GpuMesh(const SurfaceMesh& mesh)
    : origin_(mesh.origin), index_count_(static_cast<GLsizei>(mesh.indices.size())) {
  CHECK(!mesh.empty());
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  upload(GL_ARRAY_BUFFER, mesh.vertices);
  describe_surface_vertices();
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  if (mesh.vertices.size() <= 65536) {
    index_type_ = GL_UNSIGNED_SHORT;
    upload(GL_ELEMENT_ARRAY_BUFFER, std::vector<uint16_t>(mesh.indices.begin(), mesh.indices.end()));
  } else {
    index_type_ = GL_UNSIGNED_INT;
    upload(GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
  }
  glBindVertexArray(0);
  const size_t index_bytes = index_type_ == GL_UNSIGNED_SHORT ? 2 : 4;
  bytes_ = mesh.vertices.size() * sizeof(SurfaceVertex) + mesh.indices.size() * index_bytes;
}

void GpuMesh::draw() const {
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, index_type_, nullptr);
}

}  // namespace scree
