#include "shared/prop/prop_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "shared/prop/convex_hull.h"
#include "shared/prop/limits.h"

namespace scree {

namespace {

constexpr float pi = 3.14159265F;

/// Places of a circle, counterclockwise, 15 degrees apart.
constexpr int circle_sides = 24;
struct OnCircle {
  float cosine, sine;
};
constexpr OnCircle on_circle(int step) {
  constexpr std::array<float, 7> cosines{1.0F, 0.96592583F, 0.86602540F, 0.70710678F,
                                         0.5F, 0.25881905F, 0.0F};
  const int quarter = (step % circle_sides) / 6, rest = step % 6;
  const float c = cosines[static_cast<size_t>(rest)], s = cosines[static_cast<size_t>(6 - rest)];
  switch (quarter) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

bool is_ring(PropPartKind kind) {
  return kind == PropPartKind::capsule || kind == PropPartKind::cylinder;
}

/// For a part in its own axes.
struct Measured {
  float volume_m3 = 0.0F;
  glm::vec3 middle_m{0.0F};
  glm::mat3 inertia_m5{0.0F};  ///< about the middle
};

glm::mat3 diagonal(glm::vec3 moments) {
  glm::mat3 matrix(0.0F);
  for (int i = 0; i < 3; ++i) matrix[i][i] = moments[i];
  return matrix;
}

/// The tensor of a mass at a place, about the origin.
glm::mat3 of_point(float mass, glm::vec3 at) {
  return mass * (glm::mat3(glm::dot(at, at)) - glm::outerProduct(at, at));
}

/// By the tetrahedra between its faces and the middle of its corners: a hull may lie far from the origin.
/// Nothing of one that is so thin that its faces do not close.
Measured measure_hull(const std::vector<glm::vec3>& corners) {
  glm::dvec3 origin(0.0);
  for (const glm::vec3& corner : corners) origin += glm::dvec3(corner) / static_cast<double>(corners.size());
  double six_volumes = 0.0, area = 0.0;
  glm::dvec3 first(0.0), outward(0.0);
  glm::dmat3 second(0.0);
  for (const HullFace& face : hull_faces(corners))
    for (size_t i = 2; i < face.corners.size(); ++i) {
      const auto from_origin = [&](uint32_t corner) { return glm::dvec3(corners[corner]) - origin; };
      const glm::dvec3 a = from_origin(face.corners[0]), b = from_origin(face.corners[i - 1]),
                       c = from_origin(face.corners[i]), sum = a + b + c;
      const glm::dvec3 across = glm::cross(b - a, c - a);
      const double volume = glm::dot(a, glm::cross(b, c));
      outward += across;
      area += std::sqrt(glm::dot(across, across));
      six_volumes += volume;
      first += volume * sum;
      second += volume * (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                          glm::outerProduct(sum, sum));
    }
  constexpr double open_share = 0.05;
  if (!(six_volumes > 0.0) || glm::dot(outward, outward) > open_share * open_share * area * area) return {};
  const double volume = six_volumes / 6.0;
  const glm::dvec3 middle = first / (24.0 * volume);
  second /= 120.0;
  const double trace = second[0][0] + second[1][1] + second[2][2];
  const glm::dmat3 of_middle = glm::dmat3(glm::dot(middle, middle)) - glm::outerProduct(middle, middle);
  return {static_cast<float>(volume), glm::vec3(origin + middle),
          glm::mat3(glm::dmat3(trace) - second - volume * of_middle)};
}

Measured measure(const PropPart& part) {
  const float r = part.half_m.x, h = part.half_m.y;
  const float tube = 2.0F * pi * r * r * h, ball = 4.0F / 3.0F * pi * r * r * r;
  switch (part.kind) {
    case PropPartKind::box: {
      const glm::vec3 half2 = part.half_m * part.half_m;
      const float volume = 8.0F * part.half_m.x * part.half_m.y * part.half_m.z;
      return {volume,
              {},
              diagonal(volume / 3.0F * glm::vec3(half2.y + half2.z, half2.x + half2.z, half2.x + half2.y))};
    }
    case PropPartKind::sphere:
      return {ball, {}, diagonal(glm::vec3(0.4F * ball * r * r))};
    case PropPartKind::cylinder: {
      const float across = tube * (0.25F * r * r + h * h / 3.0F);
      return {tube, {}, diagonal({across, 0.5F * tube * r * r, across})};
    }
    case PropPartKind::capsule: {
      const float across =
          tube * (0.25F * r * r + h * h / 3.0F) + ball * (0.4F * r * r + h * h + 0.75F * h * r);
      return {tube + ball, {}, diagonal({across, 0.5F * tube * r * r + 0.4F * ball * r * r, across})};
    }
    case PropPartKind::hull:
      return measure_hull(part.corners_m);
  }
  return {};
}

/// Places of a ball of radius 1: the corners of an icosahedron, and the middles of its edges.
std::vector<glm::vec3> ball_points() {
  constexpr float a = 0.52573111F, b = 0.85065081F;  // both squares make 1
  std::vector<glm::vec3> points;
  for (const float s : {-a, a})
    for (const float t : {-b, b}) {
      points.push_back({s, t, 0.0F});
      points.push_back({0.0F, s, t});
      points.push_back({t, 0.0F, s});
    }
  for (size_t i = 0; i < 12; ++i)
    for (size_t k = i + 1; k < 12; ++k) {
      if (glm::dot(points[i], points[k]) < 0.4F) continue;  // no edge: those are 63 degrees apart
      const glm::vec3 sum = points[i] + points[k];
      points.push_back(sum / std::sqrt(glm::dot(sum, sum)));
    }
  return points;
}

/// The corners of a box, or the rims of a cylinder, in the part's axes.
std::vector<glm::vec3> corners_of(const PropPart& part) {
  std::vector<glm::vec3> corners;
  if (part.kind == PropPartKind::hull) return part.corners_m;
  if (part.kind == PropPartKind::box)
    for (int i = 0; i < 8; ++i)
      corners.push_back(part.half_m * glm::vec3((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1));
  if (part.kind == PropPartKind::cylinder)
    for (int i = 0; i < circle_sides; ++i)
      for (const float y : {-part.half_m.y, part.half_m.y})
        corners.push_back({part.half_m.x * on_circle(i).cosine, y, part.half_m.x * on_circle(i).sine});
  return corners;
}

std::vector<glm::vec3> placed(const PropPart& part, std::vector<glm::vec3> points) {
  const glm::mat3 turn = glm::mat3_cast(part.turn);
  for (glm::vec3& p : points) p = part.place_m + turn * p;
  return points;
}

/// Triangles of a surface of revolution about y: its profile, from below to above, as (radius, y), with
/// normals.
struct Ring {
  float radius, y;
  glm::vec2 normal;  ///< outward, upward
};

void add_triangle(PropMesh& mesh, const std::array<glm::vec3, 3>& corners,
                  const std::array<glm::vec3, 3>& normals) {
  mesh.corners_m.insert(mesh.corners_m.end(), corners.begin(), corners.end());
  mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
}

void add_band(PropMesh& mesh, const Ring& low, const Ring& high) {
  const auto place = [](const Ring& ring, const OnCircle& at) {
    return glm::vec3(ring.radius * at.cosine, ring.y, ring.radius * at.sine);
  };
  const auto normal = [](const Ring& ring, const OnCircle& at) {
    return glm::vec3(ring.normal.x * at.cosine, ring.normal.y, ring.normal.x * at.sine);
  };
  for (int i = 0; i < circle_sides; ++i) {
    const OnCircle here = on_circle(i), next = on_circle(i + 1);
    if (low.radius > 0.0F)
      add_triangle(mesh, {place(low, here), place(high, here), place(low, next)},
                   {normal(low, here), normal(high, here), normal(low, next)});
    if (high.radius > 0.0F)
      add_triangle(mesh, {place(low, next), place(high, here), place(high, next)},
                   {normal(low, next), normal(high, here), normal(high, next)});
  }
}

PropMesh round_mesh(const PropPart& part) {
  const float r = part.half_m.x, h = part.kind == PropPartKind::sphere ? 0.0F : part.half_m.y;
  PropMesh mesh;
  if (part.kind == PropPartKind::cylinder) {
    add_band(mesh, {0.0F, -h, {0.0F, -1.0F}}, {r, -h, {0.0F, -1.0F}});
    add_band(mesh, {r, -h, {1.0F, 0.0F}}, {r, h, {1.0F, 0.0F}});
    add_band(mesh, {r, h, {0.0F, 1.0F}}, {0.0F, h, {0.0F, 1.0F}});
    return mesh;
  }
  std::vector<Ring> profile;
  for (int i = -6; i <= 6; ++i) {
    const OnCircle at = on_circle((i + circle_sides) % circle_sides);
    const glm::vec2 normal(i == -6 || i == 6 ? 0.0F : at.cosine, at.sine);
    const auto add = [&](float y) { profile.push_back({r * normal.x, y + r * normal.y, normal}); };
    add(i <= 0 ? -h : h);
    if (i == 0 && h > 0.0F) add(h);
  }
  for (size_t i = 1; i < profile.size(); ++i) add_band(mesh, profile[i - 1], profile[i]);
  return mesh;
}

PropMesh flat_mesh(const std::vector<glm::vec3>& corners) {
  PropMesh mesh;
  for (const HullFace& face : hull_faces(corners))
    for (size_t i = 2; i < face.corners.size(); ++i)
      add_triangle(mesh, {corners[face.corners[0]], corners[face.corners[i - 1]], corners[face.corners[i]]},
                   {face.normal, face.normal, face.normal});
  return mesh;
}

}  // namespace

namespace {

PropMeasure sum_of(const Prop& prop, std::vector<Measured> parts) {
  PropMeasure all;
  glm::vec3 first(0.0F);
  for (size_t i = 0; i < parts.size(); ++i) {
    Measured& measured = parts[i];
    const PropPart& part = prop.parts[i];
    const glm::mat3 turn = glm::mat3_cast(part.turn);
    measured.middle_m = part.place_m + turn * measured.middle_m;
    measured.inertia_m5 = turn * measured.inertia_m5 * glm::transpose(turn);
    all.volume_m3 += measured.volume_m3;
    first += measured.volume_m3 * measured.middle_m;
  }
  if (!(all.volume_m3 > 0.0F)) return all;
  all.middle_m = first / all.volume_m3;
  for (const Measured& part : parts)
    all.inertia_m5 += part.inertia_m5 + of_point(part.volume_m3, part.middle_m - all.middle_m);
  all.inertia_m5 = 0.5F * (all.inertia_m5 + glm::transpose(all.inertia_m5));  // symmetric to the last bit
  return all;
}

std::vector<Measured> measures_of_parts(const Prop& prop) {
  std::vector<Measured> parts;
  for (const PropPart& part : prop.parts) parts.push_back(measure(part));
  return parts;
}

}  // namespace

PropMeasure measure_of(const Prop& prop) {
  return sum_of(prop, measures_of_parts(prop));
}

Result<PropMeasure> measure_checked(const Prop& prop) {
  std::vector<Measured> parts = measures_of_parts(prop);
  constexpr float least_m3 = limits::prop_half_min_m * limits::prop_half_min_m * limits::prop_half_min_m;
  for (size_t i = 0; i < parts.size(); ++i)
    if (prop.parts[i].kind == PropPartKind::hull && !(parts[i].volume_m3 > least_m3))
      return fail("a hull of the prop has no volume: its corners lie in a plane, or nearly");
  const PropMeasure all = sum_of(prop, std::move(parts));
  for (int axis = 0; axis < 3; ++axis)
    if (!(all.inertia_m5[axis][axis] > 0.0F)) return fail("the prop is too small or too thin to be turned");
  return all;
}

RoundedHull rounded_hull_of(const PropPart& part) {
  if (part.kind == PropPartKind::sphere) return {placed(part, {glm::vec3(0.0F)}), part.half_m.x};
  if (part.kind == PropPartKind::capsule)
    return {placed(part, {glm::vec3(0.0F, -part.half_m.y, 0.0F), glm::vec3(0.0F, part.half_m.y, 0.0F)}),
            part.half_m.x};
  return {placed(part, corners_of(part)), 0.0F};
}

std::vector<glm::vec3> outline_of(const PropPart& part) {
  if (part.kind != PropPartKind::sphere && part.kind != PropPartKind::capsule)
    return placed(part, corners_of(part));
  std::vector<glm::vec3> points;
  const glm::vec3 up(0.0F, part.kind == PropPartKind::capsule ? part.half_m.y : 0.0F, 0.0F);
  for (const glm::vec3& p : ball_points()) {
    if (!is_ring(part.kind) || p.y >= 0.0F) points.push_back(part.half_m.x * p + up);
    if (is_ring(part.kind) && p.y <= 0.0F) points.push_back(part.half_m.x * p - up);
  }
  return placed(part, std::move(points));
}

PropMesh mesh_of(const PropPart& part) {
  const bool is_round = part.kind != PropPartKind::box && part.kind != PropPartKind::hull;
  PropMesh mesh = is_round ? round_mesh(part) : flat_mesh(corners_of(part));
  const glm::mat3 turn = glm::mat3_cast(part.turn);
  for (glm::vec3& p : mesh.corners_m) p = part.place_m + turn * p;
  for (glm::vec3& n : mesh.normals) n = turn * n;
  return mesh;
}

float reach_of(const Prop& prop) {
  float reach2 = 0.0F;
  for (const PropPart& part : prop.parts) {
    const RoundedHull hull = rounded_hull_of(part);
    for (const glm::vec3& p : hull.points_m) {
      const float far = std::sqrt(glm::dot(p, p)) + hull.radius_m;
      reach2 = std::max(reach2, far * far);
    }
  }
  return std::sqrt(reach2);
}

}  // namespace scree
