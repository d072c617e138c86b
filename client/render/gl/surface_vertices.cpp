#include "client/render/gl/surface_vertices.h"

#include <cstddef>

#include "client/render/gl/gl.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

void describe_surface_vertices() {
  constexpr GLsizei stride = sizeof(SurfaceVertex);
  const auto at = [](size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  glVertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_FALSE, stride, at(offsetof(SurfaceVertex, position)));
  glVertexAttribPointer(1, 3, GL_BYTE, GL_TRUE, stride, at(offsetof(SurfaceVertex, normal)));
  glVertexAttribPointer(2, 1, GL_UNSIGNED_BYTE, GL_TRUE, stride, at(offsetof(SurfaceVertex, openness)));
  glVertexAttribPointer(3, 1, GL_UNSIGNED_BYTE, GL_FALSE, stride, at(offsetof(SurfaceVertex, before)));
  glVertexAttribPointer(4, 1, GL_UNSIGNED_BYTE, GL_FALSE, stride, at(offsetof(SurfaceVertex, look)));
  for (GLuint i = 0; i < 5; ++i) glEnableVertexAttribArray(i);
}

}  // namespace scree
