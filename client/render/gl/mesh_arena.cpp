#include "client/render/gl/mesh_arena.h"

#include <algorithm>

#include "client/render/gl/surface_vertices.h"
#include "shared/base/check.h"

namespace scree {
namespace {

constexpr GLuint label_attribute = 5;

/// As a draw call takes them.
const void* offset_of(size_t index) {
  return reinterpret_cast<const void*>(index * sizeof(uint32_t));
}

}  // namespace

/// The row's buffer is bound as vertices or indices only while the arena's own array object is bound, which
/// remembers it.
size_t MeshArena::put(Row& row, const void* data, size_t count, size_t bytes_each) {
  const size_t first = row.ranges.allocate(count);
  glBindBuffer(GL_COPY_WRITE_BUFFER, row.buffer.name());
  if (row.ranges.end() > row.capacity) {
    const size_t kept = row.capacity;
    row.capacity = std::max(row.ranges.end(), row.capacity + row.capacity / 2);
    gl::Buffer larger;
    // WebGL takes for indices only what was first bound as that.
    glBindVertexArray(array_.name());
    glBindBuffer(row.target, larger.name());
    glBindBuffer(GL_COPY_READ_BUFFER, row.buffer.name());
    glBindBuffer(GL_COPY_WRITE_BUFFER, larger.name());
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(row.capacity * bytes_each), nullptr,
                 GL_DYNAMIC_DRAW);
    if (kept > 0)
      glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                          static_cast<GLsizeiptr>(kept * bytes_each));
    row.buffer = std::move(larger);
  }
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(first * bytes_each),
                  static_cast<GLsizeiptr>(count * bytes_each), data);
  return first;
}

MeshArena::Slot MeshArena::add(const SurfaceMesh& mesh, VoxelCoord origin, uint16_t label) {
  CHECK(!mesh.empty());
  const VoxelCoord moved = mesh.origin - origin;
  const std::array<int, 3> steps{moved.x * surface_steps, moved.y * surface_steps, moved.z * surface_steps};
  std::vector<SurfaceVertex> vertices = mesh.vertices;
  for (SurfaceVertex& vertex : vertices)
    for (size_t axis = 0; axis < 3; ++axis) {
      const int position = vertex.position[axis] + steps[axis];
      CHECK(position >= 0 && position <= UINT16_MAX);
      vertex.position[axis] = static_cast<uint16_t>(position);
    }
  Slot slot;
  slot.vertices = vertices.size();
  slot.indices = mesh.indices.size();
  slot.first_vertex = put(vertices_, vertices.data(), slot.vertices, sizeof(SurfaceVertex));
  if (labelled_) {
    const std::vector<uint16_t> labels(slot.vertices, label);
    CHECK(put(labels_, labels.data(), slot.vertices, sizeof(uint16_t)) == slot.first_vertex);
  }
  std::vector<uint32_t> indices = mesh.indices;
  for (uint32_t& index : indices) index += static_cast<uint32_t>(slot.first_vertex);
  slot.first_index = put(indices_, indices.data(), slot.indices, sizeof(uint32_t));
  return slot;
}

void MeshArena::remove(const Slot& slot) {
  vertices_.ranges.give(slot.first_vertex, slot.vertices);
  if (labelled_) labels_.ranges.give(slot.first_vertex, slot.vertices);
  indices_.ranges.give(slot.first_index, slot.indices);
}

size_t MeshArena::draw(std::span<const Slot> slots) {
  if (slots.empty()) return 0;
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.buffer.name());
  describe_surface_vertices();
  if (labelled_) {
    glBindBuffer(GL_ARRAY_BUFFER, labels_.buffer.name());
    glVertexAttribPointer(label_attribute, 1, GL_UNSIGNED_SHORT, GL_FALSE, sizeof(uint16_t), nullptr);
    glEnableVertexAttribArray(label_attribute);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.buffer.name());
  counts_.clear();
  offsets_.clear();
  for (const Slot& slot : slots) {
    counts_.push_back(static_cast<GLsizei>(slot.indices));
    offsets_.push_back(offset_of(slot.first_index));
  }
  if (epoxy_is_desktop_gl()) {
    glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(slots.size()));
    return 1;
  }
  for (size_t i = 0; i < slots.size(); ++i)
    glDrawElements(GL_TRIANGLES, counts_[i], GL_UNSIGNED_INT, offsets_[i]);
  return slots.size();
}

size_t MeshArena::bytes() const {
  return vertices_.ranges.allocated() * sizeof(SurfaceVertex) +
         labels_.ranges.allocated() * sizeof(uint16_t) + indices_.ranges.allocated() * sizeof(uint32_t);
}

}  // namespace scree
