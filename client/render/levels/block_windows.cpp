#include "client/render/levels/block_windows.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <glm/common.hpp>
#include <utility>

#include "client/render/levels/surface_looks.h"
#include "shared/base/vector_clones.h"
#include "shared/surface/creases.h"
#include "shared/surface/marching_cubes.h"
#include "shared/surface/same_cell.h"

namespace scree {
namespace {

/// A code of the same above a surface: from here on, it faces another way than the generated one.
constexpr int turned_begins = 44;
/// Where to look at what is above a surface, voxels from it (surface_vertices.cpp).
constexpr float probe_voxels = 2.75F;

/// Voxels beyond a block's own that its vertices lie on.
constexpr int looks_reach = 2;

/// The cell around a point, or else the nearest that the window holds. Inlined: it is asked for each vertex.
SCREE_INLINE VoxelCoord cell_at(const VoxelBox& box, glm::vec3 p) {
  const auto along = [](float v, int lo, int hi) { return std::clamp(floor_to_int(v), lo, hi - 2); };
  return {along(p.x, box.lo.x, box.hi.x), along(p.y, box.lo.y, box.hi.y), along(p.z, box.lo.z, box.hi.z)};
}

/// In codes.
float trilinear(const Window& window, glm::vec3 p) {
  const VoxelBox& box = window.box;
  const VoxelCoord c = cell_at(box, p);
  const glm::vec3 f = glm::clamp(p - glm::vec3(c.x, c.y, c.z), 0.0F, 1.0F);
  const VoxelCoord size = box.size();
  const Code* at = &window.codes[window.index(c.x, c.y, c.z)];
  const auto row = [&](int x, int y) {
    const Code* from = at + (static_cast<std::ptrdiff_t>(x) * size.y + y) * size.z;
    return static_cast<float>(from[0]) + f.z * static_cast<float>(from[1] - from[0]);
  };
  const float low = row(0, 0) + f.y * (row(0, 1) - row(0, 0));
  const float high = row(1, 0) + f.y * (row(1, 1) - row(1, 0));
  return low + f.x * (high - low);
}

/// Calls f(coordinate, index in the chunk) for each brick of the chunk that the box touches.
template <typename F>
void for_each_brick_in(ChunkCoord chunk, const VoxelBox& box, F&& f) {
  const VoxelCoord first = first_voxel(chunk);
  const VoxelBox part{{std::max(box.lo.x, first.x), std::max(box.lo.y, first.y), std::max(box.lo.z, first.z)},
                      {std::min(box.hi.x, first.x + chunk_size), std::min(box.hi.y, first.y + chunk_size),
                       std::min(box.hi.z, first.z + chunk_size)}};
  for_each_brick(part, [&](BrickCoord coord) { f(coord, index_in_chunk(coord)); });
}

bool is_bit(uint64_t bits, int index) {
  return ((bits >> index) & 1U) != 0;
}

/// The common properties of a box's bricks.
struct Survey {
  bool air = true;
  bool rock = true;
  bool edited = false;
};

Survey survey(const Field& field, const VoxelBox& box) {
  Survey seen;
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const Field::ChunkBricks bricks = field.chunk_bricks(chunk);
    for_each_brick_in(chunk, box, [&](BrickCoord coord, int index) {
      const bool edited = is_bit(bricks.edited, index);
      const Brick* brick = edited ? &field.brick(coord) : bricks.generated.bricks[static_cast<size_t>(index)];
      seen.air = seen.air && brick == &air_brick();
      seen.rock = seen.rock && brick == &solid_brick();
      seen.edited = seen.edited || edited;
    });
  });
  return seen;
}

/// Rows of `count` codes. The compiler sees which number the callers give, and copies them by a register: a
/// call of memcpy takes longer than a row does.
SCREE_INLINE void copy_rows(const Code* from, Code* to, size_t stride, int rows, size_t count) {
  for (int y = 0; y < rows; ++y, from += brick_size, to += stride) std::memcpy(to, from, count);
}

/// The brick's part of the window.
void copy_brick(BrickCoord coord, const Brick& brick, Window& window) {
  constexpr size_t whole = brick_size, apron = surface_nets_apron;
  const VoxelBox& box = window.box;
  const VoxelCoord first = first_voxel(coord);
  const VoxelCoord lo{std::max(first.x, box.lo.x), std::max(first.y, box.lo.y), std::max(first.z, box.lo.z)};
  const VoxelCoord hi{std::min(first.x + brick_size, box.hi.x), std::min(first.y + brick_size, box.hi.y),
                      std::min(first.z + brick_size, box.hi.z)};
  const auto count = static_cast<size_t>(hi.z - lo.z);
  const auto stride_y = static_cast<size_t>(box.size().z);
  const size_t stride_x = stride_y * static_cast<size_t>(box.size().y);
  const Code* from =
      &brick.codes[static_cast<size_t>(Brick::index(lo.x - first.x, lo.y - first.y, lo.z - first.z))];
  Code* to = &window.at(lo.x, lo.y, lo.z);
  for (int x = lo.x; x < hi.x; ++x, from += whole * whole, to += stride_x) {
    if (count == whole)
      copy_rows(from, to, stride_y, hi.y - lo.y, whole);
    else if (count == apron)
      copy_rows(from, to, stride_y, hi.y - lo.y, apron);
    else
      copy_rows(from, to, stride_y, hi.y - lo.y, count);
  }
}

}  // namespace

SurfaceMesh BlockWindows::mesh(FaceEdges edges, const CellMask* mask, const SheetPlace* place) const {
  const Window* then = before ? &*before : nullptr;
  SurfaceMesh made = place == nullptr ? surface_nets(now, owned, then, mask)
                                      : surface_nets_placed(now, owned, then, mask, *place);
  if (edges == FaceEdges::sharp) sharpen(made);
  return finished(std::move(made));
}

void BlockWindows::sharpen(SurfaceMesh& mesh, const std::vector<bool>* fixed) const {
  if (!smooth_ground)
    sharpen_creases(now, mesh, fixed);
  else if (before)
    sharpen_creases(now, mesh, fixed, &*before);
}

SurfaceMesh BlockWindows::mesh_by_cubes(const CellMask* mask) const {
  return finished(marching_cubes(now, owned, before ? &*before : nullptr, mask));
}

SurfaceMesh BlockWindows::finished(SurfaceMesh&& made) const {
  set_looks(made);
  set_worn(made);
  if (!looks.is_ground()) part_looks(made);
  return std::move(made);
}

/// Signed: below 0 rock has gone from there, above it rock has come.
int BlockWindows::worn(const SurfaceVertex& vertex, glm::vec3 p) const {
  const int here = vertex.before;
  if (std::abs(here) >= worn_all) return here;
  const glm::vec3 normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
  const glm::vec3 above = p + normal * (probe_voxels / 127.0F);
  if (is_same_cell(now, *before, cell_at(now.box, above))) return here;
  const int gone = static_cast<int>(trilinear(now, above) - trilinear(*before, above)) - turned_begins;
  return gone > std::abs(here) ? -gone : here;
}

void BlockWindows::set_looks(SurfaceMesh& mesh) const {
  // Where nothing was edited, a vertex has no part in a cut that passes by, however far off the surface it
  // is.
  scree::set_looks(mesh, now, looks, [&](const SurfaceVertex&, glm::vec3 p) {
    return before && !is_same_cell(now, *before, cell_at(now.box, p)) && trilinear(*before, p) < cut_begins;
  });
}

void BlockWindows::set_worn(SurfaceMesh& mesh) const {
  if (!before) return;  // nothing was edited here
  const glm::vec3 origin(mesh.origin.x, mesh.origin.y, mesh.origin.z);
  for (SurfaceVertex& vertex : mesh.vertices) {
    const glm::vec3 in_mesh(vertex.position[0], vertex.position[1], vertex.position[2]);
    vertex.before = packed_worn(worn(vertex, origin + in_mesh / surface_steps_per_voxel));
  }
}

std::optional<BlockWindows> gather_windows(const Field& field, const VoxelBox& owned) {
  const VoxelBox box = owned.grown(surface_nets_apron);
  Survey seen = survey(field, box);
  if (seen.air || seen.rock) return std::nullopt;
  BlockWindows windows{owned, Window(box), std::nullopt, {}, has_smooth_ground(field.source())};
  if (seen.edited || stores_materials(field, box)) windows.looks = gather_looks(field, field, 0, box);
  if (seen.edited) windows.before.emplace(box);
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const Field::ChunkBricks bricks = field.chunk_bricks(chunk);
    for_each_brick_in(chunk, box, [&](BrickCoord coord, int index) {
      const Brick& generated = *bricks.generated.bricks[static_cast<size_t>(index)];
      copy_brick(coord, is_bit(bricks.edited, index) ? field.brick(coord) : generated, windows.now);
      if (windows.before) copy_brick(coord, generated, *windows.before);
    });
  });
  if (windows.before) spread_heaps(windows.now, *windows.before, owned.grown(looks_reach), windows.looks);
  return windows;
}

Window gather_generated(const Field& field, const VoxelBox& box) {
  Window window(box);
  for_each_brick(box, [&](BrickCoord coord) { copy_brick(coord, field.generated_brick(coord), window); });
  return window;
}

}  // namespace scree
