#include "server/bodies/hull_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/lanes.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A search ends when a step can shorten the distance by no more than this share of it.
constexpr float tolerance = 1e-3F;
/// Below 1 mm, rounding errors dominate the direction: the hulls count as overlapping.
constexpr float touching2_m2 = 1e-6F;
constexpr int steps_max = 24;  ///< more steps happen only where rounding errors make the search cycle

/// A point of the Minkowski difference a − b.
struct Point {
  glm::vec3 p;
  uint16_t a = 0;
  uint16_t b = 0;
  float share = 0.0F;  ///< its weight in the simplex's point nearest to the origin
};

/// Up to four points. Reduced: only those whose convex hull's interior holds the point nearest to the origin.
struct Simplex {
  std::array<Point, 4> points;
  int count = 0;

  void push(const Point& point) {
    CHECK_DEBUG(count < 4);
    (*this)[count++] = point;
  }
  Point& operator[](int i) { return points[static_cast<size_t>(i)]; }
  const Point& operator[](int i) const { return points[static_cast<size_t>(i)]; }
  glm::vec3 nearest() const {
    glm::vec3 sum(0.0F);
    for (int i = 0; i < count; ++i) sum += (*this)[i].p * (*this)[i].share;
    return sum;
  }
  bool holds(uint16_t a, uint16_t b) const {
    for (int i = 0; i < count; ++i)
      if ((*this)[i].a == a && (*this)[i].b == b) return true;
    return false;
  }
};

Simplex one(Point p) {
  p.share = 1.0F;
  Simplex s;
  s[0] = p;
  s.count = 1;
  return s;
}

Simplex on_segment(Point p, Point q) {
  const glm::vec3 way = q.p - p.p;
  const float along = -glm::dot(p.p, way), length2 = glm::dot(way, way);
  if (along <= 0.0F) return one(p);
  if (along >= length2) return one(q);
  q.share = along / length2;
  p.share = 1.0F - q.share;
  Simplex s;
  s[0] = p;
  s[1] = q;
  s.count = 2;
  return s;
}

Simplex nearer(const Simplex& s, const Simplex& t) {
  const glm::vec3 v = s.nearest(), w = t.nearest();
  return glm::dot(w, w) < glm::dot(v, v) ? t : s;
}

/// By the regions of the triangle: Ericson, Real-Time Collision Detection (2005), 5.1.5.
Simplex on_triangle(Point p, Point q, Point r) {
  const glm::vec3 pq = q.p - p.p, pr = r.p - p.p;
  const glm::vec3 normal = glm::cross(pq, pr);
  const float area2 = glm::dot(normal, normal);
  const float for_r = glm::dot(normal, glm::cross(p.p, q.p));
  const float for_p = glm::dot(normal, glm::cross(q.p, r.p));
  const float for_q = glm::dot(normal, glm::cross(r.p, p.p));
  const float least_area2 = 1e-10F * glm::dot(pq, pq) * glm::dot(pr, pr);
  if (area2 > least_area2 && for_p > 0.0F && for_q > 0.0F && for_r > 0.0F) {
    const float sum = for_p + for_q + for_r;
    p.share = for_p / sum;
    q.share = for_q / sum;
    r.share = for_r / sum;
    Simplex s;
    s[0] = p;
    s[1] = q;
    s[2] = r;
    s.count = 3;
    return s;
  }
  return nearer(nearer(on_segment(p, q), on_segment(q, r)), on_segment(r, p));
}

/// The nearest of the faces that have the origin on their outer side; the whole simplex, with a count of 4,
/// when the origin is inside.
Simplex on_tetrahedron(const Simplex& s) {
  static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};
  Simplex best = s;
  bool outside = false;
  for (const auto& f : faces) {
    const glm::vec3 p = s[f[0]].p;
    const glm::vec3 normal = glm::cross(s[f[1]].p - p, s[f[2]].p - p);
    const float of_origin = -glm::dot(p, normal);
    const float of_other = glm::dot(s[f[3]].p - p, normal);
    if (of_origin * of_other > 0.0F) continue;  // on the same side as the fourth point
    const Simplex face = on_triangle(s[f[0]], s[f[1]], s[f[2]]);
    best = outside ? nearer(best, face) : face;
    outside = true;
  }
  return best;
}

Simplex reduced(const Simplex& s) {
  switch (s.count) {
    case 1:
      return one(s[0]);
    case 2:
      return on_segment(s[0], s[1]);
    case 3:
      return on_triangle(s[0], s[1], s[2]);
    default:
      return on_tetrahedron(s);
  }
}

/// One pair of hulls, with the support function of their Minkowski difference.
struct Pair {
  const HullCorners& a;
  const HullCorners& b;
  glm::vec3 a_from_b;

  Point point(uint16_t corner_a, uint16_t corner_b) const {
    return {a.corner(corner_a) - b.corner(corner_b) + a_from_b, corner_a, corner_b, 0.0F};
  }
  Point support(glm::vec3 along) const { return point(a.support(along), b.support(-along)); }
};

Simplex recall(const Pair& pair, const NearestCorners& nearest) {
  if (nearest.count == 0) return one(pair.support(-pair.a_from_b));
  CHECK_DEBUG(nearest.count <= nearest.a.size());
  Simplex s;
  for (uint32_t i = 0; i < nearest.count; ++i) s.push(pair.point(nearest.a[i], nearest.b[i]));
  return s;
}

void remember(const Simplex& s, NearestCorners& nearest) {
  nearest.count = static_cast<uint32_t>(std::min(s.count, 3));
  for (uint32_t i = 0; i < nearest.count; ++i) {
    nearest.a[i] = s[static_cast<int>(i)].a;
    nearest.b[i] = s[static_cast<int>(i)].b;
  }
}

HullDistance found(const Simplex& s, const HullCorners& b, glm::vec3 v) {
  HullDistance out;
  out.kind = HullDistance::Kind::near;
  out.distance_m = std::sqrt(glm::dot(v, v));
  out.normal = v / out.distance_m;
  for (int i = 0; i < s.count; ++i) out.on_b += b.corner(s[i].b) * s[i].share;
  return out;
}

}  // namespace

HullCorners::HullCorners(const std::vector<glm::vec3>& corners) {
  CHECK(!corners.empty() && corners.size() < 65536);
  const size_t padded = (corners.size() + 3) / 4 * 4;
  own_.reserve(padded);
  own_ = corners;
  own_.resize(padded, corners[0]);
  turned_.resize(3 * padded);
  turn(glm::mat3(1.0F));
}

void HullCorners::turn(const glm::mat3& rotation) {
  float* x = turned_.data();
  for (size_t i = 0; i < own_.size(); i += 4, x += 12)
    for (size_t k = 0; k < 4; ++k) {
      const glm::vec3 p = rotation * own_[i + k];
      x[k] = p.x;
      x[k + 4] = p.y;
      x[k + 8] = p.z;
    }
}

uint16_t HullCorners::support(glm::vec3 along) const {
  const Floats ax = all(along.x), ay = all(along.y), az = all(along.z);
  Floats best = all(-1e30F);
  Ints best_at = {0, 1, 2, 3};
  Ints at = {0, 1, 2, 3};
  const float* const end = turned_.data() + turned_.size();
  for (const float* x = turned_.data(); x < end; x += 12, at += 4) {
    const Floats r = load(x) * ax + load(x + 4) * ay + load(x + 8) * az;
    const Ints farther = r > best;
    best = farther ? r : best;
    best_at = farther ? at : best_at;
  }
  int lane = 0;
  for (int i = 1; i < 4; ++i)
    if (best[i] > best[lane] || (best[i] == best[lane] && best_at[i] < best_at[lane])) lane = i;
  return static_cast<uint16_t>(best_at[lane]);
}

HullDistance distance_between(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b, float reach_m,
                              NearestCorners& nearest) {
  const Pair pair{a, b, a_from_b};
  Simplex simplex = reduced(recall(pair, nearest));
  for (int step = 0; step < steps_max; ++step) {
    const glm::vec3 v = simplex.nearest();
    const float v2 = glm::dot(v, v);
    if (simplex.count == 4 || v2 < touching2_m2) break;
    const Point next = pair.support(-v);
    const float ahead =
        glm::dot(v, next.p);  // a plane across v at `ahead`/v2 of its length separates a and b
    if (ahead > 0.0F && ahead * ahead > v2 * reach_m * reach_m) {
      remember(simplex, nearest);
      return {};
    }
    if (v2 - ahead <= tolerance * v2 || simplex.holds(next.a, next.b) || step + 1 == steps_max) {
      remember(simplex, nearest);
      return found(simplex, b, v);
    }
    simplex.push(next);
    simplex = reduced(simplex);
  }
  nearest.count = 0;
  HullDistance overlapping;
  overlapping.kind = HullDistance::Kind::overlapping;
  return overlapping;
}

}  // namespace scree
