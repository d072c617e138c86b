#include "shared/field/sharp_vertex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace scree {
namespace {

/// Directions in which the planes say less than this share of the best are left alone: normals are off by
/// some hundredths, which must not move a vertex along an edge.
constexpr float weakest_share = 0.02F;

struct Eigen {
  glm::mat3 vectors{1.0F};  ///< columns
  glm::vec3 values{0.0F};
};

/// Jacobi rotations of a symmetric matrix: exact enough after four sweeps of three.
Eigen eigen_of(glm::mat3 a) {
  Eigen result;
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(a[p][q]) < 1e-9F) continue;
        const float theta = (a[q][q] - a[p][p]) / (2.0F * a[p][q]);
        const float t = (theta >= 0.0F ? 1.0F : -1.0F) / (std::abs(theta) + std::sqrt(theta * theta + 1.0F));
        const float c = 1.0F / std::sqrt(t * t + 1.0F), s = t * c;
        glm::mat3 turn(1.0F);
        turn[p][p] = c;
        turn[q][q] = c;
        turn[q][p] = s;
        turn[p][q] = -s;
        a = glm::transpose(turn) * a * turn;
        result.vectors = result.vectors * turn;
      }
    }
  }
  result.values = {a[0][0], a[1][1], a[2][2]};
  return result;
}

/// A plane of the surface: n · x = offset. Without a normal where nothing tells one.
struct Plane {
  glm::vec3 normal{0.0F};
  float offset = 0.0F;
  int supporters = 0;  ///< of the 26 points around one, that lie where the plane says
};

/// What the rounding of three codes does at most, and a little; voxels.
constexpr float agreement_voxels = 0.04F;

/// A lattice point, and what the field says around it.
struct Place {
  const Window& window;
  VoxelCoord p;

  float distance(VoxelCoord off) const { return decode(window.at(p.x + off.x, p.y + off.y, p.z + off.z)); }
  bool is_saturated(VoxelCoord off) const {
    const Code code = window.at(p.x + off.x, p.y + off.y, p.z + off.z);
    return code == code_air || code == code_solid;
  }
};

glm::vec3 as_vector(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Calls f(offset, distance there beyond the one here) for the points around that agree with the gradient.
template <typename F>
void for_each_supporter(const Place& place, glm::vec3 gradient, F&& f) {
  const float here = place.distance({});
  for (int i = 0; i < 27; ++i) {
    const VoxelCoord off{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
    if (i == 13 || place.is_saturated(off)) continue;
    const float rise = place.distance(off) - here;
    if (std::abs(rise - glm::dot(gradient, as_vector(off))) <= agreement_voxels) f(as_vector(off), rise);
  }
}

/// The gradient that fits its supporters best.
glm::vec3 fitted(const Place& place, glm::vec3 gradient) {
  glm::mat3 a(0.0F);
  glm::vec3 b(0.0F);
  for_each_supporter(place, gradient, [&](glm::vec3 off, float rise) {
    a += glm::outerProduct(off, off);
    b += off * rise;
  });
  return glm::determinant(a) > 1.0F ? glm::inverse(a) * b : gradient;
}

/// The plane of the face that the point is nearest to. Across an edge of the rock the differences on either
/// side of the point differ, and of each axis only one belongs to that face: of the eight ways to choose, the
/// one that most points around agree with.
Plane plane_at(const Place& place) {
  const float here = place.distance({});
  std::array<std::array<float, 2>, 3> sides;
  for (size_t axis = 0; axis < 3; ++axis) {
    const VoxelCoord step{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
    sides[axis] = {here - place.distance(VoxelCoord{} - step), place.distance(step) - here};
  }
  Plane best;
  for (size_t i = 0; i < 8; ++i) {
    const glm::vec3 gradient(sides[0][i >> 2], sides[1][(i >> 1) & 1], sides[2][i & 1]);
    const float length = std::sqrt(glm::dot(gradient, gradient));
    if (std::abs(length - 1.0F) > 0.1F) continue;
    int supporters = 0;
    for_each_supporter(place, gradient, [&](glm::vec3, float) { ++supporters; });
    if (supporters > best.supporters) best = {gradient, 0.0F, supporters};
  }
  if (best.supporters == 0) return best;
  best.normal = fitted(place, best.normal);
  best.normal /= std::sqrt(glm::dot(best.normal, best.normal));
  best.offset = glm::dot(best.normal, as_vector(place.p)) - here;
  return best;
}

/// Told by the crossing's lattice point in rock, or by the one in air. By an edge one of them sees the face
/// rounded off, in rock where the edge is concave, in air where it is convex; more points agree about the
/// other.
Plane plane_of(const Window& window, glm::vec3 p, int axis) {
  const auto whole = [&](int i) { return static_cast<int>(std::floor(p[i] + (axis == i ? 0.0F : 0.5F))); };
  const VoxelCoord low{whole(0), whole(1), whole(2)};
  const VoxelCoord high = low + VoxelCoord{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
  const Plane a = plane_at({window, low}), b = plane_at({window, high});
  return a.supporters >= b.supporters ? a : b;
}

}  // namespace

glm::vec3 sharp_vertex(const Window& window, VoxelCoord cell, std::span<const LeafCrossing> crossings) {
  const glm::vec3 mean = mean_of(crossings);
  const glm::vec3 low(static_cast<float>(cell.x), static_cast<float>(cell.y), static_cast<float>(cell.z));
  glm::mat3 a(0.0F);
  glm::vec3 b(0.0F);
  for (const LeafCrossing& crossing : crossings) {
    const Plane plane = plane_of(window, low + crossing.at, crossing.axis);
    a += glm::outerProduct(plane.normal, plane.normal);
    b += plane.normal * (plane.offset - glm::dot(plane.normal, low + mean));
  }
  const Eigen eigen = eigen_of(a);
  const float largest = std::max({eigen.values.x, eigen.values.y, eigen.values.z});
  glm::vec3 off(0.0F);
  for (int i = 0; i < 3; ++i)
    if (eigen.values[i] > weakest_share * largest)
      off += eigen.vectors[i] * (glm::dot(eigen.vectors[i], b) / eigen.values[i]);
  return mean + off;
}

}  // namespace scree
