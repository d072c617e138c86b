#include "shared/prop/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// How far off a plane a point may lie and count as in it, as a share of the points' extent.
constexpr float flat_share = 1e-4F;

float extent_of(const std::vector<glm::vec3>& points) {
  float extent = 0.0F;
  for (const glm::vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, std::abs(p[axis] - points.front()[axis]));
  return extent;
}

/// The corners of a face in order around its normal (Jarvis's march): the next is always the one that has all
/// others to its left. Points on an edge between two corners are left out.
std::vector<uint32_t> in_order(const std::vector<glm::vec3>& points, const std::vector<uint32_t>& flat,
                               glm::vec3 normal) {
  std::vector<uint32_t> order;
  const auto is_before = [&](uint32_t i, uint32_t k) {
    const glm::vec3 &p = points[i], &q = points[k];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
  };
  uint32_t at = *std::ranges::min_element(flat, is_before);  // one of the hull's corners
  const uint32_t first = at;
  do {
    order.push_back(at);
    uint32_t next = at;
    for (const uint32_t i : flat) {
      if (i == at) continue;
      if (next == at) {
        next = i;
        continue;
      }
      const glm::vec3 there = points[next] - points[at], here = points[i] - points[at];
      const float left = glm::dot(glm::cross(there, here), normal);
      const float slack = flat_share * std::sqrt(glm::dot(there, there) * glm::dot(here, here));
      if (left < -slack || (left <= slack && glm::dot(here, here) > glm::dot(there, there))) next = i;
    }
    at = next;
  } while (at != first && order.size() <= flat.size());
  return order;
}

/// Points, x, y and z apart, so that vector instructions can look at several.
struct Apart {
  explicit Apart(size_t count) : x(count), y(count), z(count) {}
  void put(size_t i, const glm::vec3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }

  std::vector<float> x, y, z;
};

/// Directions to a cube's faces and corners. The points that reach farthest along them lie on both sides of
/// nearly every plane that is no face.
constexpr size_t farthest_count = 14;
std::array<glm::vec3, farthest_count> farthest_of(const std::vector<glm::vec3>& points) {
  constexpr std::array<std::array<float, 3>, farthest_count> directions{{{1, 0, 0},
                                                                         {-1, 0, 0},
                                                                         {0, 1, 0},
                                                                         {0, -1, 0},
                                                                         {0, 0, 1},
                                                                         {0, 0, -1},
                                                                         {1, 1, 1},
                                                                         {1, 1, -1},
                                                                         {1, -1, 1},
                                                                         {1, -1, -1},
                                                                         {-1, 1, 1},
                                                                         {-1, 1, -1},
                                                                         {-1, -1, 1},
                                                                         {-1, -1, -1}}};
  std::array<glm::vec3, farthest_count> found;
  for (size_t i = 0; i < farthest_count; ++i) {
    const glm::vec3 along(directions[i][0], directions[i][1], directions[i][2]);
    const auto is_nearer = [&](const glm::vec3& p, const glm::vec3& q) {
      return glm::dot(p, along) < glm::dot(q, along);
    };
    found[i] = *std::max_element(points.begin(), points.end(), is_nearer);
  }
  return found;
}

/// Says of each of `count` points c whether the plane through a, b and c may be a face. It is none where some
/// of the farthest points lie beyond `slack` times its normal's length, by the sum of its axes, on both
/// sides. All are relative to a.
SCREE_VECTOR_CLONES
void find_planes(size_t count, const float* __restrict x, const float* __restrict y,
                 const float* __restrict z, const glm::vec3& b, const float* __restrict farthest_x,
                 const float* __restrict farthest_y, const float* __restrict farthest_z, float slack,
                 int32_t* __restrict may_be) {
  for (size_t i = 0; i < count; ++i) {
    const float nx = b.y * z[i] - b.z * y[i], ny = b.z * x[i] - b.x * z[i], nz = b.x * y[i] - b.y * x[i];
    const float beyond = slack * (std::abs(nx) + std::abs(ny) + std::abs(nz));
    int32_t above = 0, below = 0;
    for (size_t k = 0; k < farthest_count; ++k) {
      const float off = farthest_x[k] * nx + farthest_y[k] * ny + farthest_z[k] * nz;
      above |= off > beyond ? 1 : 0;
      below |= off < -beyond ? 1 : 0;
    }
    may_be[i] = (above & below) ^ 1;
  }
}

/// By how much the distances of the quick test, whose normals are longer, must exceed those of the exact one:
/// far more than both round.
constexpr float quick_slack = 1.05F;

}  // namespace

std::vector<HullFace> hull_faces(const std::vector<glm::vec3>& points_m) {
  CHECK(!points_m.empty());
  const float slack = flat_share * extent_of(points_m);
  std::vector<HullFace> faces;
  const auto count = static_cast<uint32_t>(points_m.size());
  const auto ends = farthest_of(points_m);
  Apart from_a(count), farthest(farthest_count);
  std::vector<int32_t> may_be(count);
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t i = 0; i < count; ++i) from_a.put(i, points_m[i] - points_m[a]);
    for (size_t k = 0; k < farthest_count; ++k) farthest.put(k, ends[k] - points_m[a]);
    for (uint32_t b = a + 1; b < count; ++b) {
      const size_t left = count - (b + 1);
      find_planes(left, from_a.x.data() + b + 1, from_a.y.data() + b + 1, from_a.z.data() + b + 1,
                  points_m[b] - points_m[a], farthest.x.data(), farthest.y.data(), farthest.z.data(),
                  quick_slack * slack, may_be.data() + b + 1);
      for (uint32_t c = b + 1; c < count; ++c) {
        if (may_be[c] == 0) continue;
        glm::vec3 normal = glm::cross(points_m[b] - points_m[a], points_m[c] - points_m[a]);
        const float length = std::sqrt(glm::dot(normal, normal));
        if (!(length > slack * slack)) continue;
        normal /= length;
        const auto off = [&](uint32_t i) { return glm::dot(points_m[i] - points_m[a], normal); };
        bool above = false, below = false;
        for (uint32_t i = 0; i < count && !(above && below); ++i) {
          above = above || off(i) > slack;
          below = below || off(i) < -slack;
        }
        if (above == below) continue;
        std::vector<uint32_t> flat;
        for (uint32_t i = 0; i < count; ++i)
          if (off(i) <= slack && off(i) >= -slack) flat.push_back(i);
        if (above) normal = -normal;
        const auto has_all = [&](const HullFace& face) {
          const auto is_in = [&](uint32_t i) {
            return std::abs(glm::dot(points_m[i] - points_m[face.corners.front()], face.normal)) <=
                   2.0F * slack;
          };
          return glm::dot(face.normal, normal) > 0.0F && is_in(a) && is_in(b) && is_in(c);
        };
        const bool known = std::ranges::any_of(faces, has_all);
        if (!known) faces.push_back({in_order(points_m, flat, normal), normal});
      }
    }
  }
  return faces;
}

}  // namespace scree
