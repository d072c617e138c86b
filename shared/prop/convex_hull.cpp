#include "shared/prop/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/base/check.h"

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

}  // namespace

std::vector<HullFace> hull_faces(const std::vector<glm::vec3>& points_m) {
  CHECK(!points_m.empty());
  const float slack = flat_share * extent_of(points_m);
  std::vector<HullFace> faces;
  const auto count = static_cast<uint32_t>(points_m.size());
  for (uint32_t a = 0; a < count; ++a)
    for (uint32_t b = a + 1; b < count; ++b)
      for (uint32_t c = b + 1; c < count; ++c) {
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
  return faces;
}

}  // namespace scree
