#include "shared/surface/creases.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

#include "shared/base/check.h"
#include "shared/field/voxel_vector.h"
#include "shared/surface/face_plane.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

/// Where the field is flatter than this, faces meet at 30 degrees or more. Roundings make a flat face 0.98.
constexpr float slope_flat = 0.965F;
/// Planes that lie farther from the mean of the crossings belong to another wall.
constexpr float same_wall_voxels = 1.2F;
/// Cosine of the angle between two faces beyond which they are the sides of one wall: 160 degrees.
constexpr float other_side_cosine = -0.94F;
/// Planes that pass by the meeting point farther away than this are of no common edge.
constexpr float meeting_voxels = 0.2F;
/// A vertex this near to a plane lies on its face.
constexpr float on_face_voxels = 0.12F;
/// Share of the planes' weight that holds a vertex where the planes say nothing, such as along an edge:
/// normals have errors of some hundredths, which must not move it there.
constexpr float hold = 0.002F;
/// Sine of the angle to an edge at which a third face cuts it off.
constexpr float third_face_sine = 0.35F;
/// A point this near to a cell counts as inside.
constexpr float beside_voxels = 0.02F;

/// The planes of a window's points, each computed by the first call for it.
class PlaneMap {
 public:
  explicit PlaneMap(const Window& window) : window_(window) {}

  const FacePlane& at(VoxelCoord point) {
    if (slots_.empty()) slots_.resize(window_.codes.size());
    uint16_t& slot = slots_[window_.index(point.x, point.y, point.z)];
    if (slot == 0) {
      planes_.push_back(face_plane_at(window_, point));
      slot = static_cast<uint16_t>(planes_.size());
      CHECK(planes_.size() < 65535);
    }
    return planes_[slot - 1U];
  }
  const Window& window() const { return window_; }

 private:
  const Window& window_;
  std::vector<uint16_t> slots_;  ///< index in planes_ + 1; 0: not computed yet
  std::vector<FacePlane> planes_;
};

/// As many as a cell has corners and points beyond them.
constexpr size_t planes_max = 32;

/// The known planes of a cell's corners that are near a point.
struct CellPlanes {
  std::array<glm::vec3, planes_max> normal;
  std::array<float, planes_max> distance;  ///< of the point from each
  size_t count = 0;

  /// `out`: the field's direction there: faces that turn away from it are the other side of a thin wall.
  CellPlanes(PlaneMap& planes, VoxelCoord cell, glm::vec3 at, glm::vec3 out) : out_(out) {
    for (int i = 0; i < cell_corners; ++i) add(planes, cell + cell_corner(i), at);
  }
  /// Also those of the 24 points one voxel beyond the corners: an edge may cut off a part of the cell that
  /// holds none of them.
  void look_beyond(PlaneMap& planes, VoxelCoord cell, glm::vec3 at) {
    for (int i = 0; i < cell_corners; ++i) {
      const VoxelCoord from = cell_corner(i), out{2 * from.x - 1, 2 * from.y - 1, 2 * from.z - 1};
      add(planes, cell + from + VoxelCoord{out.x, 0, 0}, at);
      add(planes, cell + from + VoxelCoord{0, out.y, 0}, at);
      add(planes, cell + from + VoxelCoord{0, 0, out.z}, at);
    }
  }
  /// Whether they belong to more than one face.
  bool is_edge() const {
    if (count < 2) return false;
    const float cosine = glm::dot(normal[0], normal[farthest()]);
    return cosine < face_edge_cosine && cosine > other_side_cosine;
  }
  /// The one whose normal differs most from the first one's.
  size_t farthest() const {
    size_t found = 0;
    float least = 1.0F;
    for (size_t i = 1; i < count; ++i)
      if (const float cosine = glm::dot(normal[0], normal[i]); cosine < least) {
        least = cosine;
        found = i;
      }
    return found;
  }
  /// The direction of the edge in which two faces meet; none where three do.
  std::optional<glm::vec3> along_edge() const {
    const glm::vec3 along = glm::normalize(glm::cross(normal[0], normal[farthest()]));
    for (size_t i = 0; i < count; ++i)
      if (std::abs(glm::dot(along, normal[i])) > third_face_sine) return std::nullopt;
    return along;
  }
  /// From the point to the nearest one on all of them.
  glm::vec3 way_to_meeting() const {
    glm::mat3 a(hold * static_cast<float>(count));
    glm::vec3 b(0.0F);
    for (size_t i = 0; i < count; ++i) {
      a += glm::outerProduct(normal[i], normal[i]);
      b -= normal[i] * distance[i];
    }
    return glm::inverse(a) * b;
  }
  void add(PlaneMap& planes, VoxelCoord point, glm::vec3 at) {
    const FacePlane& plane = planes.at(point);
    if (!plane.is_known()) return;
    const glm::vec3 n = plane.direction();
    const float away = decode(plane.code) + glm::dot(n, at - as_vector(point));
    if (std::abs(away) > same_wall_voxels || glm::dot(n, out_) < other_side_cosine) return;
    normal[count] = n;
    distance[count++] = away;
  }
  /// Whether all of them pass by the point that lies this way.
  bool meet_at(glm::vec3 way) const {
    for (size_t i = 0; i < count; ++i)
      if (std::abs(distance[i] + glm::dot(normal[i], way)) > meeting_voxels) return false;
    return true;
  }
  /// Drops those that are farther from the point.
  void keep_near(float voxels) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
      if (std::abs(distance[i]) > voxels) continue;
      normal[kept] = normal[i];
      distance[kept++] = distance[i];
    }
    count = kept;
  }
  glm::vec3 mean_normal() const {
    glm::vec3 sum(0.0F);
    for (size_t i = 0; i < count; ++i) sum += normal[i];
    return sum;
  }

 private:
  glm::vec3 out_;
};

/// The point of a cell nearest to `from` on the line along an edge; none if the line misses the cell.
std::optional<glm::vec3> on_line_in(VoxelCoord cell, glm::vec3 from, glm::vec3 along) {
  const glm::vec3 lo = as_vector(cell) - beside_voxels - from, hi = lo + (1.0F + 2.0F * beside_voxels);
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
  Sharpener(const Window& window, SurfaceMesh& mesh, const std::vector<bool>* fixed)
      : planes_(window), mesh_(mesh), fixed_(fixed) {
    CHECK_EQ(mesh.slopes.size(), mesh.vertices.size());
    CHECK(fixed == nullptr || fixed->size() == mesh.vertices.size());
  }

  void run() {
    for (size_t i = 0; i < mesh_.vertices.size(); ++i)
      if (mesh_.slopes[i] < slope_flat && (fixed_ == nullptr || !(*fixed_)[i]))
        bent_.push_back(static_cast<uint32_t>(i));
    rebase();
    if (bent_.empty()) return;
    is_crease_.resize(mesh_.vertices.size());
    for (const uint32_t i : bent_) {
      move(i);
      if (!is_crease_[i]) face(mesh_.vertices[i]);
    }
    if (any_ && fixed_ == nullptr) split_quads();
  }

 private:
  static constexpr int steps = surface_steps;
  static constexpr int moved_steps = crease_reach * surface_steps;

  VoxelCoord cell_of(const SurfaceVertex& vertex) const {
    return mesh_.origin +
           VoxelCoord{vertex.position[0] / steps, vertex.position[1] / steps, vertex.position[2] / steps};
  }

  void rebase() {
    mesh_.origin = mesh_.origin - VoxelCoord{crease_reach, crease_reach, crease_reach};
    for (SurfaceVertex& vertex : mesh_.vertices)
      for (uint16_t& p : vertex.position) p = static_cast<uint16_t>(p + moved_steps);
  }

  static glm::vec3 normal_of(const SurfaceVertex& vertex) {
    return glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) * (1.0F / 127.0F);
  }
  glm::vec3 place_of(const SurfaceVertex& vertex) const {
    return as_vector(mesh_.origin) +
           glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel;
  }

  /// Whether a vertex of `home` may lie in a cell: its own, or one that has no vertex.
  bool may_hold(VoxelCoord cell, VoxelCoord home) const {
    if (cell == home) return true;
    const VoxelCoord off = cell - home;
    if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > crease_reach) return false;
    const Window& window = planes_.window();
    int rock = 0;
    for (int i = 0; i < cell_corners; ++i) {
      const VoxelCoord p = cell + cell_corner(i);
      rock += window.at(p.x, p.y, p.z) < 0 ? 1 : 0;
    }
    return rock == 0 || rock == cell_corners;
  }

  void move(uint32_t index) {
    SurfaceVertex& vertex = mesh_.vertices[index];
    const glm::vec3 from = place_of(vertex);
    const VoxelCoord home = cell_of(vertex);
    CellPlanes planes(planes_, home, from, normal_of(vertex));
    if (!planes.is_edge()) planes.look_beyond(planes_, home, from);
    if (!planes.is_edge()) return;
    const glm::vec3 way = planes.way_to_meeting();
    if (!planes.meet_at(way)) return;
    glm::vec3 to = from + way;
    if (const auto along = planes.along_edge())
      if (const auto inside = on_line_in(home, to, *along)) to = *inside;
    const glm::vec3 in_home =
        glm::clamp(to, as_vector(home), as_vector(home) + (1.0F - 1.0F / surface_steps_per_voxel));
    if (glm::distance(to, in_home) < 2.0F * beside_voxels) to = in_home;
    if (!may_hold({floor_to_int(to.x), floor_to_int(to.y), floor_to_int(to.z)}, home)) return;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      const std::array<int, 3> origin{mesh_.origin.x, mesh_.origin.y, mesh_.origin.z};
      const auto at =
          static_cast<int>((to[i] - static_cast<float>(origin[axis])) * surface_steps_per_voxel + 0.5F);
      vertex.position[axis] = static_cast<uint16_t>(std::clamp(at, 0, 65535));
    }
    set_normal(vertex, planes.mean_normal(), crease_normal_length);
    is_crease_[index] = true;
    any_ = true;
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

  /// Central differences reach over an edge; the planes on which the vertex lies do not.
  void face(SurfaceVertex& vertex) {
    CellPlanes planes(planes_, cell_of(vertex), place_of(vertex), normal_of(vertex));
    planes.keep_near(on_face_voxels);
    if (planes.count > 0 && !planes.is_edge()) set_normal(vertex, planes.mean_normal(), 127);
  }

  PlaneMap planes_;
  SurfaceMesh& mesh_;
  const std::vector<bool>* fixed_;
  std::vector<uint32_t> bent_;
  std::vector<bool> is_crease_;
  bool any_ = false;
};

}  // namespace

void sharpen_creases(const Window& window, SurfaceMesh& mesh, const std::vector<bool>* fixed) {
  Sharpener(window, mesh, fixed).run();
}

}  // namespace scree
