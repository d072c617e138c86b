#include "shared/surface/creases.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "shared/base/check.h"
#include "shared/field/voxel_vector.h"
#include "shared/surface/cell_planes.h"
#include "shared/surface/same_cell.h"

namespace scree {
namespace {

/// Where the field is flatter than this, faces meet at 30 degrees or more. Roundings make a flat face 0.98.
constexpr float slope_flat = 0.965F;
/// Corners that know the face of a cell whose edge lies between them; by chance fewer do.
constexpr size_t corners_least = 2;
/// A tip may lie so far from where the values of the field are 0, because between codes they round it: half a
/// voxel.
constexpr float off_surface_codes = 21.0F;
/// A vertex this near to a plane lies on its face.
constexpr float on_face_voxels = 0.12F;
/// A point this near to a cell counts as inside.
constexpr float beside_voxels = 0.02F;

/// The point of the cell 0 … 1 nearest to `from` on the line along an edge; none if the line misses the cell.
std::optional<glm::vec3> on_line_in_cell(glm::vec3 from, glm::vec3 along) {
  const glm::vec3 lo = -beside_voxels - from, hi = lo + (1.0F + 2.0F * beside_voxels);
  float first = -4.0F, last = 4.0F;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(along[i]) < 1e-5F) {
      if (lo[i] > 0.0F || hi[i] < 0.0F) return std::nullopt;
      continue;
    }
    const float s = lo[i] / along[i], t = hi[i] / along[i];
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
  }
  if (first > last) return std::nullopt;
  return from + along * std::clamp(0.0F, first, last);
}

class Sharpener {
 public:
  Sharpener(const Window& window, SurfaceMesh& mesh, const std::vector<bool>* fixed, const Window* smooth)
      : faces_(window), mesh_(mesh), fixed_(fixed), smooth_(smooth) {
    CHECK(smooth == nullptr || smooth->box == window.box);
    CHECK_EQ(mesh.slopes.size(), mesh.vertices.size());
    CHECK(fixed == nullptr || fixed->size() == mesh.vertices.size());
  }

  void run() {
    rebase();
    is_crease_.resize(mesh_.vertices.size());
    for (size_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (fixed_ != nullptr && (*fixed_)[i]) continue;
      if (smooth_ != nullptr && is_same_cell(faces_.window(), *smooth_, home_of(mesh_.vertices[i]).cell))
        continue;
      if (mesh_.slopes[i] < slope_flat)
        move(i);
      else
        shift_to_step(i, home_of(mesh_.vertices[i]));
    }
    if (any_ && fixed_ == nullptr) split_quads();
  }

 private:
  static constexpr int steps = surface_steps;
  static constexpr int moved_steps = crease_reach * surface_steps;

  void rebase() {
    mesh_.origin = mesh_.origin - VoxelCoord{crease_reach, crease_reach, crease_reach};
    for (SurfaceVertex& vertex : mesh_.vertices)
      for (uint16_t& p : vertex.position) p = static_cast<uint16_t>(p + moved_steps);
  }

  CellVertex home_of(const SurfaceVertex& vertex) const {
    const VoxelCoord cell = mesh_.origin + VoxelCoord{vertex.position[0] / steps, vertex.position[1] / steps,
                                                      vertex.position[2] / steps};
    const size_t index = faces_.window().index(cell.x, cell.y, cell.z);
    const glm::vec3 in_cell(vertex.position[0] % steps, vertex.position[1] % steps,
                            vertex.position[2] % steps);
    return {cell, index, in_cell / surface_steps_per_voxel};
  }

  /// Whether a vertex of `home` may lie in a cell: its own, or one that has no vertex.
  bool may_hold(VoxelCoord cell, VoxelCoord home) const {
    if (cell == home) return true;
    const VoxelCoord off = cell - home;
    if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > crease_reach) return false;
    const Window& window = faces_.window();
    int rock = 0;
    for (int i = 0; i < cell_corners; ++i) {
      const VoxelCoord p = cell + cell_corner(i);
      rock += window.at(p.x, p.y, p.z) < 0 ? 1 : 0;
    }
    return rock == 0 || rock == cell_corners;
  }

  /// Whether the field says that a place is clearly not on the surface: planes that meet there are of faces
  /// that end before.
  bool off_surface(VoxelCoord cell, glm::vec3 in_cell) const {
    const Window& window = faces_.window();
    float code = 0.0F;
    for (int i = 0; i < cell_corners; ++i) {
      const VoxelCoord corner = cell_corner(i), p = cell + corner;
      const glm::vec3 share = glm::mix(1.0F - in_cell, in_cell, as_vector(corner));
      code += share.x * share.y * share.z * static_cast<float>(window.at(p.x, p.y, p.z));
    }
    return std::abs(code) > off_surface_codes;
  }

  /// To the edge of its cell, if there is one; else it gets the normal of the face on which it lies.
  void move(size_t index) {
    SurfaceVertex& vertex = mesh_.vertices[index];
    CellVertex home = home_of(vertex);
    CellPlanes planes;
    planes.look_at_corners(faces_, home);
    const size_t of_corners = planes.count();
    if (of_corners >= corners_least && !planes.is_edge()) {
      // Beside an edge the field's direction is another than the face's. On a thin wall it is not.
      if (planes.is_straight(home.out(faces_))) return;
      planes.look_beyond(faces_, home);
    }
    if (const auto way = planes.way_to_edge(); way && shift(index, home, *way, planes)) return;
    if (shift_to_step(index, home)) return;
    planes.keep_first(of_corners);
    planes.keep_near(on_face_voxels);
    // Central differences reach over an edge; the planes on which the vertex lies do not.
    if (planes.count() > 0 && !planes.is_edge()) set_normal(vertex, planes.mean_normal(), 127);
  }

  bool shift_to_step(size_t index, const CellVertex& home) {
    CellPlanes across;
    across.look_across(faces_, home);
    const auto way = across.way_to_edge();
    return way && shift(index, home, *way, across);
  }

  /// Whether the vertex may lie there.
  bool shift(size_t index, const CellVertex& home, glm::vec3 way, const CellPlanes& planes) {
    glm::vec3 to = home.at + way;
    if (const auto along = planes.along_edge())
      if (const auto inside = on_line_in_cell(to, *along)) to = *inside;
    const glm::vec3 in_home =
        glm::clamp(to, glm::vec3(0.0F), glm::vec3(1.0F - 1.0F / surface_steps_per_voxel));
    if (glm::distance(to, in_home) < 2.0F * beside_voxels) to = in_home;
    const VoxelCoord to_cell{floor_to_int(to.x), floor_to_int(to.y), floor_to_int(to.z)};
    if (!may_hold(home.cell + to_cell, home.cell)) return false;
    if (off_surface(home.cell + to_cell, to - as_vector(to_cell))) return false;
    SurfaceVertex& vertex = mesh_.vertices[index];
    const VoxelCoord off = home.cell - mesh_.origin;
    const std::array<int, 3> from{off.x * steps, off.y * steps, off.z * steps};
    for (size_t i = 0; i < 3; ++i) {
      const int at = floor_to_int(to[static_cast<int>(i)] * surface_steps_per_voxel + 0.5F);
      vertex.position[i] = static_cast<uint16_t>(std::clamp(from[i] + at, 0, 65535));
    }
    set_normal(vertex, planes.mean_normal(), crease_normal_length);
    is_crease_[index] = true;
    any_ = true;
    return true;
  }

  static void set_normal(SurfaceVertex& vertex, glm::vec3 sum, int length) {
    const float squared = glm::dot(sum, sum);
    if (squared < 1e-6F) return;
    const glm::vec3 n = sum * (static_cast<float>(length) / std::sqrt(squared));
    for (int i = 0; i < 3; ++i)
      vertex.normal[static_cast<size_t>(i)] = static_cast<int8_t>(n[i] + (n[i] < 0.0F ? -0.5F : 0.5F));
  }

  /// Quads with two opposite vertices on an edge are split along it.
  void split_quads() {
    std::vector<uint32_t>& indices = mesh_.indices;
    CHECK_EQ(indices.size() % 6, size_t{0});
    for (size_t q = 0; q < indices.size(); q += 6) {
      const std::array<uint32_t, 4> quad{indices[q], indices[q + 1], indices[q + 2], indices[q + 5]};
      const auto is_crease = [&](size_t i) { return static_cast<bool>(is_crease_[quad[i]]); };
      const bool other = is_crease(1) && is_crease(3) && !(is_crease(0) && is_crease(2));
      if (!other) continue;
      const std::array<uint32_t, 6> turned{quad[1], quad[2], quad[3], quad[1], quad[3], quad[0]};
      std::ranges::copy(turned, indices.begin() + static_cast<std::ptrdiff_t>(q));
    }
  }

  FaceMap faces_;
  SurfaceMesh& mesh_;
  const std::vector<bool>* fixed_;
  const Window* smooth_;
  std::vector<bool> is_crease_;
  bool any_ = false;
};

}  // namespace

void sharpen_creases(const Window& window, SurfaceMesh& mesh, const std::vector<bool>* fixed,
                     const Window* smooth) {
  Sharpener(window, mesh, fixed, smooth).run();
}

}  // namespace scree
