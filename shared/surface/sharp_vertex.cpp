#include "shared/surface/sharp_vertex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// The vertex is not moved in directions that the planes fix by less than this share of the best one: normals
/// have errors of some hundredths, which must not move a vertex along an edge.
constexpr float weakest_share = 0.02F;
/// The share of the codes that faces must explain. The others may belong to a third face, near a corner.
constexpr float explained_min = 0.7F;

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

/// The best of the corners tried so far.
class BestCorner {
 public:
  BestCorner(const PointBlock& block, glm::vec3 mean) : block_(block), mean_(mean), at_(mean) {}

  void attempt(std::span<const RockFace* const> faces) {
    const std::optional<glm::vec3> x = meeting_point(faces, mean_);
    if (!x) return;
    for (const Corner corner : {Corner::convex, Corner::concave}) {
      const float share = explained_share(block_, faces, corner);
      if (share < explained_min || share <= share_) continue;
      share_ = share;
      at_ = *x;
    }
  }
  bool explains_all() const { return share_ == 1.0F; }
  std::optional<glm::vec3> at() const { return share_ > 0.0F ? std::optional(at_) : std::nullopt; }

 private:
  const PointBlock& block_;
  glm::vec3 mean_;
  glm::vec3 at_;
  float share_ = 0.0F;
};

/// The crossed edge's ends, from the cell's lowest corner.
std::array<VoxelCoord, 2> ends_of(const LeafCrossing& crossing) {
  const auto low = [&](int i) { return crossing.axis != i && crossing.at[i] > 0.5F ? 1 : 0; };
  const VoxelCoord from{low(0), low(1), low(2)};
  const int axis = crossing.axis;
  return {from, from + VoxelCoord{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}};
}

}  // namespace

glm::vec3 SharpVertices::place(VoxelCoord cell, std::span<const LeafCrossing> crossings) {
  const glm::vec3 mean = mean_of(crossings);
  const PointBlock block(facets_.window(), cell);
  if (block.is_flat()) return mean;
  const std::vector<RockFace> faces = rock_faces(facets_, cell);
  BestCorner best(block, mean);
  for (const RockFace& face : faces) best.attempt(std::array{&face});
  if (!best.explains_all()) {
    for (size_t i = 0; i < faces.size(); ++i)
      for (size_t j = i + 1; j < faces.size(); ++j) {
        best.attempt(std::array{&faces[i], &faces[j]});
        for (size_t k = j + 1; k < faces.size(); ++k)
          best.attempt(std::array{&faces[i], &faces[j], &faces[k]});
      }
  }
  return best.at() ? *best.at() : least_squares(cell, crossings, mean);
}

/// The least-squares solution nearest the mean; directions that the planes do not fix keep the mean's.
glm::vec3 SharpVertices::least_squares(VoxelCoord cell, std::span<const LeafCrossing> crossings,
                                       glm::vec3 mean) {
  glm::mat3 a(0.0F);
  glm::vec3 b(0.0F);
  for (const LeafCrossing& crossing : crossings) {
    const auto [low, high] = ends_of(crossing);
    // The end with more supporters: near the other the face may be rounded.
    const Facet at_low = facets_.at(cell + low), at_high = facets_.at(cell + high);
    const bool is_low = at_low.supporters >= at_high.supporters;
    const Facet& facet = is_low ? at_low : at_high;
    if (!facet.is_known()) continue;
    const float offset = facet.offset + glm::dot(facet.normal, as_vector(is_low ? low : high));
    a += glm::outerProduct(facet.normal, facet.normal);
    b += facet.normal * (offset - glm::dot(facet.normal, mean));
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
