#include "client/render/gl/gpu_mesh.h"

#include <cstddef>
#include <vector>

#include "shared/base/check.h"

namespace scree {
namespace {

const void* offset(size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

template <typename T>
void upload(GLenum target, const std::vector<T>& data) {
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
}

void describe_vertex() {
  constexpr GLsizei stride = sizeof(SurfaceVertex);
  glVertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_FALSE, stride, offset(offsetof(SurfaceVertex, position)));
  glVertexAttribPointer(1, 3, GL_BYTE, GL_TRUE, stride, offset(offsetof(SurfaceVertex, normal)));
  glVertexAttribPointer(2, 1, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(SurfaceVertex, openness)));
  glVertexAttribPointer(3, 1, GL_BYTE, GL_TRUE, stride, offset(offsetof(SurfaceVertex, before)));
  glVertexAttribPointer(4, 1, GL_UNSIGNED_BYTE, GL_FALSE, stride, offset(offsetof(SurfaceVertex, paint)));
  for (GLuint i = 0; i < 5; ++i) glEnableVertexAttribArray(i);
}

}  // namespace

GpuMesh::GpuMesh(const SurfaceMesh& mesh)
    : origin_(mesh.origin), index_count_(static_cast<GLsizei>(mesh.indices.size())) {
  CHECK(!mesh.empty());
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  upload(GL_ARRAY_BUFFER, mesh.vertices);
  describe_vertex();
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
