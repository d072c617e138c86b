#include "server/bodies/body_shape.h"

#include <LinearMath/btConvexHullComputer.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/lanes.h"
#include "server/bodies/limits.h"
#include "server/bodies/to_bullet.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Lines through a cube's middle, four to a vector: to faces, edges and corners. The last three repeat the
/// first one.
struct CubeLines {
  Floats x, y, z, length;
};
constexpr float of_edges = 1.41421356F, of_corners = 1.73205081F;
constexpr CubeLines cube_lines[] = {
    {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0}, {1, 1, 1, of_edges}},
    {{1, 1, 1, 0}, {-1, 0, 0, 1}, {0, 1, -1, 1}, {of_edges, of_edges, of_edges, of_edges}},
    {{0, 1, 1, 1}, {1, 1, 1, -1}, {-1, 1, -1, 1}, {of_edges, of_corners, of_corners, of_corners}},
    {{1, 1, 1, 1}, {-1, 0, 0, 0}, {-1, 0, 0, 0}, {of_corners, 1, 1, 1}},
};

/// Appends points of a triangle on a lattice of at most `spacing_m`, without its corners.
void fill_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, float spacing_m, std::vector<glm::vec3>& out) {
  const float longest =
      std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
  const int steps = static_cast<int>(longest / spacing_m) + 1;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      if (i == steps || j == steps || i + j == 0) continue;
      const float u = static_cast<float>(i) / static_cast<float>(steps);
      const float v = static_cast<float>(j) / static_cast<float>(steps);
      out.push_back(a + (b - a) * u + (c - a) * v);
    }
}

/// Bullet's hull with tight bounds: its own are those of the turned box around the hull, which meet twice as
/// many others.
class TightHull final : public btConvexHullShape {
 public:
  explicit TightHull(const std::vector<glm::vec3>& corners) {
    const size_t padded = (corners.size() + 3) / 4 * 4;
    coordinates_.resize(3 * padded);
    for (size_t i = 0; i < padded; ++i) {
      const glm::vec3& p = corners[i < corners.size() ? i : 0];
      for (int axis = 0; axis < 3; ++axis)
        coordinates_[i / 4 * 12 + static_cast<size_t>(axis) * 4 + i % 4] = p[axis];
    }
    m_unscaledPoints.reserve(static_cast<int>(corners.size()));
    for (const glm::vec3& p : corners) addPoint(to_bullet(p), false);
  }

  void getAabb(const btTransform& at, btVector3& lo, btVector3& hi) const override {
    for (int axis = 0; axis < 3; ++axis) {
      const btVector3& along = at.getBasis()[axis];
      const auto [least, most] = extent(along);
      lo[axis] = at.getOrigin()[axis] + (least - getMargin());
      hi[axis] = at.getOrigin()[axis] + (most + getMargin());
    }
  }

 private:
  std::pair<float, float> extent(const btVector3& along) const {
    const Floats ax = all(along.x()), ay = all(along.y()), az = all(along.z());
    Floats least = all(1e30F), most = all(-1e30F);
    for (size_t i = 0; i < coordinates_.size(); i += 12) {
      const float* const x = &coordinates_[i];
      const Floats r = load(x) * ax + load(x + 4) * ay + load(x + 8) * az;
      least = r < least ? r : least;
      most = r > most ? r : most;
    }
    return {std::min({least[0], least[1], least[2], least[3]}),
            std::max({most[0], most[1], most[2], most[3]})};
  }

  /// Four x, y and z of the corners behind each other; copies pad the corners to a multiple of four.
  std::vector<float> coordinates_;
};

bool near_any(const std::vector<glm::vec3>& points, glm::vec3 p, float distance) {
  return std::ranges::any_of(points,
                             [&](glm::vec3 q) { return glm::dot(p - q, p - q) < distance * distance; });
}

}  // namespace

// The least support over 26 directions, both ways along each line.
float thickness_of(const std::vector<glm::vec3>& hull_m, glm::vec3 middle_m) {
  float thickness = 1e30F;
  for (const CubeLines& lines : cube_lines) {
    Floats least = all(1e30F), most = all(-1e30F);
    for (const glm::vec3& p : hull_m) {
      const glm::vec3 off = p - middle_m;
      const Floats r = all(off.x) * lines.x + all(off.y) * lines.y + all(off.z) * lines.z;
      least = r < least ? r : least;
      most = r > most ? r : most;
    }
    const Floats one_way = most / lines.length, other_way = -least / lines.length;
    for (int i = 0; i < 4; ++i) thickness = std::min({thickness, one_way[i], other_way[i]});
  }
  return thickness;
}

std::unique_ptr<btConvexHullShape> make_convex_shape(const std::vector<glm::vec3>& hull_m, glm::vec3 middle_m,
                                                     float gap_m) {
  CHECK(hull_m.size() >= 4 && is_sound(middle_m));
  const float thickness = std::max(thickness_of(hull_m, middle_m), 0.01F);
  const float margin = std::clamp(0.1F * thickness, 0.005F, limits::margin_max_m);
  const float scale = std::max(1.0F - (margin + gap_m) / thickness, 0.5F);
  std::vector<glm::vec3> corners = hull_m;
  for (glm::vec3& corner : corners) corner = middle_m + (corner - middle_m) * scale;
  auto shape = std::make_unique<TightHull>(corners);
  shape->setMargin(margin);
  shape->recalcLocalAabb();  // setMargin leaves the cached bounds stale
  return shape;
}

std::unique_ptr<btConvexHullShape> make_rounded_shape(const std::vector<glm::vec3>& points_m,
                                                      float radius_m) {
  CHECK(!points_m.empty() && radius_m > 0.0F);
  auto shape = std::make_unique<TightHull>(points_m);
  shape->setMargin(radius_m);
  shape->recalcLocalAabb();
  return shape;
}

std::vector<glm::vec3> corners_of(const btConvexHullShape& shape) {
  std::vector<glm::vec3> corners;
  corners.reserve(static_cast<size_t>(shape.getNumPoints()));
  for (int i = 0; i < shape.getNumPoints(); ++i) {
    const btVector3& p = shape.getUnscaledPoints()[i];
    corners.emplace_back(p.x(), p.y(), p.z());
  }
  return corners;
}

std::vector<glm::vec3> surface_points(const std::vector<glm::vec3>& hull_m, float spacing_m) {
  CHECK(!hull_m.empty() && spacing_m > 0.0F);
  std::vector<glm::vec3> points = hull_m;
  if (radius_of(hull_m) <= 2.0F * spacing_m) return points;  // its corners are near enough to each other
  btConvexHullComputer computer;
  computer.compute(&hull_m[0].x, sizeof(glm::vec3), static_cast<int>(hull_m.size()), 0.0F, 0.0F);
  const auto corner = [&](int i) {
    const btVector3& v = computer.vertices[i];
    return glm::vec3(v.x(), v.y(), v.z());
  };
  for (float spacing = spacing_m;; spacing *= 2.0F) {
    points = hull_m;
    std::vector<glm::vec3> extra;
    for (int f = 0; f < computer.faces.size(); ++f) {
      const auto* first = &computer.edges[computer.faces[f]];
      const glm::vec3 a = corner(first->getSourceVertex());
      for (const auto* e = first->getNextEdgeOfFace(); e->getTargetVertex() != first->getSourceVertex();
           e = e->getNextEdgeOfFace())
        fill_triangle(a, corner(e->getSourceVertex()), corner(e->getTargetVertex()), spacing, extra);
    }
    for (const glm::vec3& p : extra) {
      if (points.size() > limits::samples_max) break;
      if (!near_any(points, p, 0.5F * spacing)) points.push_back(p);
    }
    if (points.size() <= limits::samples_max || points.size() == hull_m.size()) return points;
  }
}

float radius_of(const std::vector<glm::vec3>& points_m) {
  float reach2 = 0.0F;
  for (const glm::vec3& p : points_m) reach2 = std::max(reach2, glm::dot(p, p));
  return std::sqrt(reach2);
}

}  // namespace scree
