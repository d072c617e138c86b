#include "server/bodies/face_contacts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace scree {

namespace {

/// How far a corner of the face may lie behind the foremost one, as a share of the distance to it: the sine
/// of three degrees.
constexpr float tilt_share = 0.05F;
constexpr float tilt_least_m = 0.002F;

/// A corner of a face, in the plane across the normal, and how far along it.
struct Corner {
  glm::vec2 at;
  float height;
};

float cross(glm::vec2 a, glm::vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// The axes across a unit normal.
struct Across {
  glm::vec3 u, v;

  explicit Across(glm::vec3 n) {
    const glm::vec3 least = std::abs(n.x) < 0.6F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 side = glm::cross(n, least);
    u = side / std::sqrt(glm::dot(side, side));
    v = glm::cross(n, u);
  }
};

/// The corners of the face of a hull that looks along `sign` times the normal, in order around it (Andrew's
/// monotone chain).
std::vector<Corner> face_of(const HullCorners& hull, glm::vec3 off, glm::vec3 normal, float sign,
                            const Across& across) {
  const glm::vec3 foremost = hull.corner(hull.support(normal * sign)) + off;
  std::vector<Corner> corners;
  for (size_t i = 0; i < hull.size(); ++i) {
    const glm::vec3 corner = hull.corner(static_cast<uint16_t>(i)) + off, to = corner - foremost;
    const float behind = -sign * glm::dot(to, normal);
    if (behind > tilt_least_m && behind * behind > tilt_share * tilt_share * glm::dot(to, to)) continue;
    corners.push_back({{glm::dot(corner, across.u), glm::dot(corner, across.v)}, glm::dot(corner, normal)});
  }
  std::ranges::sort(corners, [](const Corner& a, const Corner& b) {
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
  });
  if (corners.size() < 3) return corners;
  std::vector<Corner> ring;
  const auto add = [&](const Corner& corner, size_t keep) {
    while (ring.size() >= keep + 2 &&
           cross(ring.back().at - ring[ring.size() - 2].at, corner.at - ring.back().at) <= 0.0F)
      ring.pop_back();
    ring.push_back(corner);
  };
  for (const Corner& corner : corners) add(corner, 0);
  const size_t lower = ring.size() - 1;
  for (size_t i = corners.size() - 1; i-- > 0;) add(corners[i], lower);
  ring.pop_back();
  return ring;
}

/// The height of a face's plane above a place, by the foremost of its corners and its slope.
class Plane {
 public:
  explicit Plane(const std::vector<Corner>& face) : base_(face.front()) {
    if (face.size() < 3) {
      const glm::vec2 along = face.back().at - base_.at;
      const float length2 = glm::dot(along, along);
      if (length2 > 0.0F) slope_ = along * ((face.back().height - base_.height) / length2);
      return;
    }
    // The triangle over its first corner that is widest.
    float widest = 0.0F;
    for (size_t i = 2; i < face.size(); ++i) {
      const glm::vec2 b = face[i - 1].at - base_.at, c = face[i].at - base_.at;
      const float area = cross(b, c);
      if (area <= widest) continue;
      widest = area;
      const float up_b = face[i - 1].height - base_.height, up_c = face[i].height - base_.height;
      slope_ = glm::vec2(up_b * c.y - up_c * b.y, up_c * b.x - up_b * c.x) / area;
    }
  }
  float at(glm::vec2 place) const { return base_.height + glm::dot(slope_, place - base_.at); }

 private:
  Corner base_;
  glm::vec2 slope_{0.0F};
};

/// The part of a ring, or of a segment, within a ring.
std::vector<glm::vec2> clip(const std::vector<Corner>& shape, const std::vector<Corner>& within) {
  std::vector<glm::vec2> points;
  for (const Corner& corner : shape) points.push_back(corner.at);
  for (size_t i = 0; i < within.size() && !points.empty(); ++i) {
    const glm::vec2 from = within[i].at, along = within[(i + 1) % within.size()].at - from;
    const auto inside = [&](glm::vec2 p) { return cross(along, p - from); };
    std::vector<glm::vec2> kept;
    const size_t sides = points.size() == 2 ? 1 : points.size();
    if (points.size() == 1 && inside(points.front()) >= 0.0F) kept.push_back(points.front());
    for (size_t k = 0; points.size() > 1 && k < sides; ++k) {
      const glm::vec2 p = points[k], q = points[(k + 1) % points.size()];
      const float in_p = inside(p), in_q = inside(q);
      if (in_p >= 0.0F) kept.push_back(p);
      if ((in_p >= 0.0F) != (in_q >= 0.0F)) kept.push_back(p + (q - p) * (in_p / (in_p - in_q)));
      if (sides == 1 && in_q >= 0.0F) kept.push_back(q);
    }
    points = std::move(kept);
  }
  return points;
}

}  // namespace

std::vector<FaceContact> face_contacts(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b,
                                       glm::vec3 normal) {
  const Across across(normal);
  const std::vector<Corner> face_a = face_of(a, a_from_b, normal, -1.0F, across),
                            face_b = face_of(b, glm::vec3(0.0F), normal, 1.0F, across);
  if (face_a.size() < 2 || face_b.size() < 2 || face_a.size() + face_b.size() < 5) return {};
  const bool a_within_b = face_b.size() >= 3;
  const std::vector<glm::vec2> area = a_within_b ? clip(face_a, face_b) : clip(face_b, face_a);
  const Plane of_a(face_a), of_b(face_b);
  std::vector<FaceContact> contacts;
  for (const glm::vec2& place : area) {
    const float low = of_b.at(place);
    contacts.push_back({across.u * place.x + across.v * place.y + normal * low, of_a.at(place) - low});
  }
  return contacts;
}

}  // namespace scree
