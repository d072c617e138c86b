#include "server/colliders/nearest_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "server/colliders/sound_values.h"
#include "shared/base/check.h"
#include "shared/field/window_sample.h"

namespace scree {

namespace {

constexpr int bin_voxels = 2;

/// By the Voronoi regions of corners, edges and face: Ericson, Real-Time Collision Detection (2005), 5.1.5.
glm::vec3 closest_on(const TerrainTriangle& triangle, glm::vec3 p) {
  const auto& [a, b, c] = triangle.corners;
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0F && d2 <= 0.0F) return a;
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0F && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return a + ab * (d1 / (d1 - d3));
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0F && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return a + ac * (d2 / (d2 - d6));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F)
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const float whole = va + vb + vc;
  return a + ab * (vb / whole) + ac * (vc / whole);
}

}  // namespace

TriangleBins::Sphere TriangleBins::sphere_around(const TerrainTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const glm::vec3 middle = 0.5F * (glm::min(a, glm::min(b, c)) + glm::max(a, glm::max(b, c)));
  float radius2 = 0.0F;
  for (const glm::vec3& corner : triangle.corners)
    radius2 = std::max(radius2, glm::dot(corner - middle, corner - middle));
  return {middle, std::sqrt(radius2)};
}

TriangleBins::TriangleBins(std::vector<TerrainTriangle> triangles, const VoxelBox& box) : box_(box) {
  if (triangles.empty()) return;
  const auto bins = [](int lo, int hi) { return (hi - lo + bin_voxels - 1) / bin_voxels; };
  size_ = {bins(box.lo.x, box.hi.x), bins(box.lo.y, box.hi.y), bins(box.lo.z, box.hi.z)};
  first_.assign(
      static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z) + 1, 0);
  std::vector<size_t> bin_of(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Sphere sphere = sphere_around(triangles[i]);
    const glm::vec3 middle = sphere.middle;
    extent_ = std::max(extent_, sphere.radius);
    bin_of[i] =
        static_cast<size_t>((bin(0, middle.x) * size_.y + bin(1, middle.y)) * size_.z + bin(2, middle.z));
    ++first_[bin_of[i] + 1];
  }
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  triangles_.resize(triangles.size());
  spheres_.resize(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    const uint32_t at = next[bin_of[i]]++;
    triangles_[at] = triangles[i];
    spheres_[at] = sphere_around(triangles[i]);
  }
  CHECK_DEBUG(std::ranges::is_sorted(first_) && first_.back() == triangles_.size());
}

/// A coordinate beyond the box belongs to the outermost bin.
int TriangleBins::bin(int axis, float x) const {
  const int lo = axis == 0 ? box_.lo.x : axis == 1 ? box_.lo.y : box_.lo.z;
  const int count = axis == 0 ? size_.x : axis == 1 ? size_.y : size_.z;
  const int at = floor_to_int((x - static_cast<float>(lo)) / static_cast<float>(bin_voxels));
  return std::clamp(at, 0, count - 1);
}

std::optional<NearestTriangle> TriangleBins::nearest(glm::vec3 p, float reach) const {
  if (triangles_.empty()) return std::nullopt;
  CHECK_DEBUG(reach > 0.0F);
  // Two triangles that share the nearest edge have the same distance. The one whose plane is farther from p
  // tells on which side of the surface p lies.
  constexpr float same = 1e-5F, rounding = 0.01F;
  const float around = reach + extent_;
  float root = reach, least = reach * reach, square = 0.0F;
  const TerrainTriangle* best = nullptr;
  const int x_hi = bin(0, p.x + around), y_hi = bin(1, p.y + around);
  const int z_lo = bin(2, p.z - around), z_hi = bin(2, p.z + around);
  for (int x = bin(0, p.x - around); x <= x_hi; ++x)
    for (int y = bin(1, p.y - around); y <= y_hi; ++y) {
      const size_t row = static_cast<size_t>((x * size_.y + y) * size_.z);
      const uint32_t end = first_[row + static_cast<size_t>(z_hi) + 1];
      for (uint32_t i = first_[row + static_cast<size_t>(z_lo)]; i < end; ++i) {
        const glm::vec3 apart = p - spheres_[i].middle;
        const float farthest = root + spheres_[i].radius + rounding;
        if (glm::dot(apart, apart) > farthest * farthest) continue;
        const TerrainTriangle& triangle = triangles_[i];
        const glm::vec3 off = p - closest_on(triangle, p);
        const float distance2 = glm::dot(off, off);
        const float along = glm::dot(off, triangle.normal);
        if (distance2 > least + same) continue;
        if (best != nullptr && distance2 > least - same && std::abs(along) <= std::abs(square)) continue;
        best = &triangle;
        least = std::min(least, distance2);
        root = std::sqrt(least);
        square = along;
      }
    }
  if (best == nullptr) return std::nullopt;
  CHECK_DEBUG(is_unit(best->normal) && root <= reach + rounding);
  return NearestTriangle{best->normal, square < 0.0F ? -root : root};
}

}  // namespace scree
