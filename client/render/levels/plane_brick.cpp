#include "client/render/levels/plane_brick.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>

#include "shared/base/vector_clones.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Planes reach no farther from the surface than this: rays that end in a cell read its corners.
constexpr int plane_code_max = 85;
/// A neighbour's plane that is off by less than this, from roundings, says a point's own distance.
constexpr float same_distance_voxels = 0.06F;
/// Codes of a flat face bend by less than this along an axis.
constexpr int bend_most = 5;
/// Codes that a distance grows by in a voxel straight to or from a face, less a rounding.
constexpr int straight_least = 41;
/// Two planes are of one face up to this angle, 10 degrees; from face_edge_cosine on they are of two.
constexpr float one_face_cosine = 0.985F;
/// Angles between faces beyond 35 degrees are clear; below, so many corners must know their faces.
constexpr float clear_edge_cosine = 0.82F;
constexpr int corners_of_small_angle = 6;
/// Codes on the wrong side of the surface, by roundings.
constexpr float wrong_side_voxels = 0.05F;

/// Whether codes near the surface bend anywhere: a quick test that spares smooth bricks the rest.
SCREE_VECTOR_CLONES bool is_bent(const Code* codes, std::ptrdiff_t count, std::ptrdiff_t step_x,
                                 std::ptrdiff_t step_y) {
  int16_t found = 0;
  for (std::ptrdiff_t i = step_x; i < count - step_x; ++i) {
    const auto twice = static_cast<int16_t>(2 * codes[i]);
    const auto x = static_cast<int16_t>(codes[i - step_x] + codes[i + step_x] - twice);
    const auto y = static_cast<int16_t>(codes[i - step_y] + codes[i + step_y] - twice);
    const auto z = static_cast<int16_t>(codes[i - 1] + codes[i + 1] - twice);
    const auto bends = [](int16_t bend) {
      return static_cast<int16_t>(static_cast<int16_t>(bend > bend_most) |
                                  static_cast<int16_t>(bend < -bend_most));
    };
    const auto near = static_cast<int16_t>(static_cast<int16_t>(codes[i] < plane_code_max) &
                                           static_cast<int16_t>(codes[i] > -plane_code_max));
    found = static_cast<int16_t>(found | static_cast<int16_t>((bends(x) | bends(y) | bends(z)) & near));
  }
  return found != 0;
}

/// Samples −1 … 9: those of a brick and one more around.
constexpr int wide_side = corner_brick_side + 2;
using WidePlanes = std::array<FacePlane, wide_side * wide_side * wide_side>;

size_t wide_index(VoxelCoord v) {
  return static_cast<size_t>(((v.x + 1) * wide_side + v.y + 1) * wide_side + v.z + 1);
}

constexpr std::array<VoxelCoord, 6> beside{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// Whether a plane says that distance at a place that lies so from its point.
bool says(const FacePlane& plane, VoxelCoord off, Code code) {
  const glm::vec3 n = plane.direction();
  const float said = decode(plane.code) + glm::dot(n, as_vector(off));
  return std::abs(said - decode(code)) < same_distance_voxels;
}

/// Beside a step of a voxel a point is as near to one face as to another, both straight ahead: then it has
/// the one that fewer of its neighbours know. `v` counts from the brick's first voxel.
std::optional<FacePlane> rarer_face(const WidePlanes& planes, VoxelCoord v) {
  const FacePlane& own = planes[wide_index(v)];
  std::optional<FacePlane> found;
  int fewest = 7;
  std::array<bool, 3> axes{};
  for (size_t i = 0; i < beside.size(); ++i) {
    const VoxelCoord off = beside[i];
    // The face lies towards `off`: codes fall by a voxel in a voxel where it is air, or rise where it is
    // rock.
    const int rise = planes[wide_index(v + off)].code - own.code;
    if (std::abs(rise) < straight_least || (rise < 0) != (own.code >= 0)) continue;
    const int sign = own.code >= 0 ? -127 : 127;
    const FacePlane face{{static_cast<int8_t>(sign * off.x), static_cast<int8_t>(sign * off.y),
                          static_cast<int8_t>(sign * off.z)},
                         own.code};
    axes[i / 2] = true;
    int known = 0;
    for (const VoxelCoord at : beside) {
      const FacePlane& other = planes[wide_index(v + at)];
      known += other.is_known() && glm::dot(other.direction(), face.direction()) > one_face_cosine &&
                       says(other, VoxelCoord{} - at, own.code)
                   ? 1
                   : 0;
    }
    if (known >= fewest) continue;
    fewest = known;
    found = face;
  }
  return axes[0] + axes[1] + axes[2] >= 2 ? found : std::nullopt;
}

/// The plane at a point, or else a neighbour's that says the same distance there: beside an edge of thin rock
/// too few points lie on a face.
FacePlane plane_beside(const WidePlanes& planes, VoxelCoord v) {
  const FacePlane& own = planes[wide_index(v)];
  if (own.is_known() || std::abs(own.code) > plane_code_max) return own;
  if (const auto face = rarer_face(planes, v)) return *face;
  for (const VoxelCoord off : beside) {
    const FacePlane& other = planes[wide_index(v + off)];
    if (other.is_known() && says(other, VoxelCoord{} - off, own.code)) return {other.normal, own.code};
  }
  return own;
}

constexpr std::ptrdiff_t corners_along = corner_brick_side;

/// The corners of a cell, and what they know.
struct Corners {
  std::array<glm::vec3, 8> normal;
  std::array<float, 8> distance;
  std::array<VoxelCoord, 8> at;
  std::array<bool, 8> known;

  explicit Corners(const FacePlane* lowest) {
    for (size_t i = 0; i < 8; ++i) {
      at[i] = {static_cast<int>(i >> 2), static_cast<int>((i >> 1) & 1), static_cast<int>(i & 1)};
      const FacePlane& plane = lowest[(at[i].x * corners_along + at[i].y) * corners_along + at[i].z];
      known[i] = plane.is_known();
      normal[i] = plane.direction();
      distance[i] = decode(plane.code);
    }
  }
  /// Whether their planes are of several faces, each clearly. Where these meet at a small angle, a few
  /// corners alone may lie on round rock.
  bool show_faces() const {
    float least = 1.0F;
    std::array<unsigned, 8> same{};
    for (size_t i = 0; i < 8; ++i)
      for (size_t j = i + 1; j < 8; ++j) {
        if (!known[i] || !known[j]) continue;
        const float cosine = glm::dot(normal[i], normal[j]);
        if (cosine < one_face_cosine && cosine > face_edge_cosine) return false;
        least = std::min(least, cosine);
        if (cosine < one_face_cosine) continue;
        same[i] |= 1U << j;
        same[j] |= 1U << i;
      }
    if (least > face_edge_cosine) return false;
    // No corner is of two faces that others tell apart.
    for (size_t i = 0; i < 8; ++i)
      for (size_t j = i + 1; j < 8; ++j)
        if (known[i] && known[j] && (same[i] >> j & 1U) == 0 && (same[i] & same[j]) != 0) return false;
    return least < clear_edge_cosine || std::ranges::count(known, true) >= corners_of_small_angle;
  }
  /// Whether a ray that takes the planes in place of the corner's distance stays on its side.
  bool keep_sides() const {
    for (size_t i = 0; i < 8; ++i) {
      float most = -100.0F, least = 100.0F;
      for (size_t j = 0; j < 8; ++j) {
        if (!known[j]) continue;
        const float away = distance[j] + glm::dot(normal[j], as_vector(at[i] - at[j]));
        most = std::max(most, away);
        least = std::min(least, away);
      }
      const float shown = std::clamp(distance[i], least, most);
      if (distance[i] < 0.0F ? shown > wrong_side_voxels : shown < -wrong_side_voxels) return false;
    }
    return true;
  }
};

void mark(FacePlane& lowest) {
  if (!lowest.is_known()) {
    lowest.normal = {edge_no_normal_length, 0, 0};
    return;
  }
  for (int8_t& n : lowest.normal)
    n = static_cast<int8_t>((n * edge_normal_length + (n < 0 ? -63 : 63)) / 127);
}

/// Marks the cells that are edges; returns whether there are any.
bool mark_edges(PlaneBrick& planes) {
  const PlaneBrick unmarked = planes;
  bool any = false;
  for (std::ptrdiff_t x = 0; x + 1 < corners_along; ++x)
    for (std::ptrdiff_t y = 0; y + 1 < corners_along; ++y)
      for (std::ptrdiff_t z = 0; z + 1 < corners_along; ++z) {
        const auto at = static_cast<size_t>((x * corners_along + y) * corners_along + z);
        const Corners corners(&unmarked[at]);
        if (!corners.show_faces() || !corners.keep_sides()) continue;
        mark(planes[at]);
        any = true;
      }
  return any;
}

/// As client/shaders/bricks.glsl tells the marks.
bool is_marked(const FacePlane& lowest) {
  int square = 0;
  for (const int8_t n : lowest.normal) square += n * n;
  constexpr int least = 22 * 22, most = 113 * 113;
  return square > least && square < most;
}

}  // namespace

uint32_t edge_eighths(const PlaneBrick& planes) {
  uint32_t eighths = 0;
  for (uint32_t x = 0; x < brick_size; ++x)
    for (uint32_t y = 0; y < brick_size; ++y)
      for (uint32_t z = 0; z < brick_size; ++z)
        if (is_marked(planes[(x * corner_brick_side + y) * corner_brick_side + z]))
          eighths |= 1U << (x / 4 * 4 + y / 4 * 2 + z / 4);
  return eighths;
}

std::unique_ptr<PlaneBrick> planes_of(const Window& window, VoxelCoord first) {
  constexpr int samples_along = corner_brick_side;
  const VoxelBox samples{first, first + VoxelCoord{samples_along, samples_along, samples_along}};
  const Window near = part_of(window, samples.grown(plane_brick_reach));
  const VoxelCoord size = near.box.size();
  const std::ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  if (!is_bent(near.codes.data(), static_cast<std::ptrdiff_t>(near.codes.size()), step_x, step_y))
    return nullptr;
  WidePlanes wide;
  size_t i = 0;
  for (int x = -1; x <= samples_along; ++x)
    for (int y = -1; y <= samples_along; ++y)
      for (int z = -1; z <= samples_along; ++z, ++i) {
        const VoxelCoord point = first + VoxelCoord{x, y, z};
        wide[i].code = near.at(point.x, point.y, point.z);
        if (std::abs(wide[i].code) <= plane_code_max) wide[i] = face_plane_at(near, point);
      }
  auto planes = std::make_unique<PlaneBrick>();
  i = 0;
  for (int x = 0; x < samples_along; ++x)
    for (int y = 0; y < samples_along; ++y)
      for (int z = 0; z < samples_along; ++z, ++i) (*planes)[i] = plane_beside(wide, {x, y, z});
  return mark_edges(*planes) ? std::move(planes) : nullptr;
}

}  // namespace scree
