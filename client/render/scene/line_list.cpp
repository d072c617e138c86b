#include "client/render/scene/line_list.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "client/render/scene/limits.h"
#include "shared/base/check.h"

namespace scree {
namespace {

constexpr int circle_sides = 32;

/// Any unit vector at a right angle.
glm::vec3 across(glm::vec3 axis) {
  const glm::vec3 other = std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace

LineColour shaded(LineColour colour, glm::vec3 normal) {
  const float light =
      0.45F + 0.55F * glm::max(glm::dot(normal, glm::normalize(glm::vec3(0.7F, 0.6F, 0.4F))), 0.0F);
  const auto part = [light](uint8_t value) {
    return static_cast<uint8_t>(static_cast<float>(value) * light);
  };
  return {part(colour.red), part(colour.green), part(colour.blue), 255};
}

void LineList::line(glm::vec3 from_m, glm::vec3 to_m, LineColour colour) {
  if (vertices_.size() + 2 > 2 * limits::lines_max) return;
  vertices_.push_back({from_m, colour});
  vertices_.push_back({to_m, colour});
}

void LineList::triangle(glm::vec3 a_m, glm::vec3 b_m, glm::vec3 c_m, LineColour colour) {
  if (corners_.size() + 3 > 3 * limits::lines_max) return;
  for (const glm::vec3 corner_m : {a_m, b_m, c_m}) corners_.push_back({corner_m, colour});
}

void LineList::box(glm::vec3 lo_m, glm::vec3 hi_m, LineColour colour, glm::quat turn, glm::vec3 move_m) {
  const auto corner = [&](int i) {
    const glm::vec3 at((i & 1) != 0 ? hi_m.x : lo_m.x, (i & 2) != 0 ? hi_m.y : lo_m.y,
                       (i & 4) != 0 ? hi_m.z : lo_m.z);
    return turn * at + move_m;
  };
  for (int i = 0; i < 8; ++i)
    for (const int axis : {1, 2, 4})
      if ((i & axis) == 0) line(corner(i), corner(i | axis), colour);
}

void LineList::circle(glm::vec3 centre_m, glm::vec3 axis, float radius_m, LineColour colour) {
  const glm::vec3 u = across(axis) * radius_m;
  const glm::vec3 v = glm::cross(axis, u);
  const auto at = [&](int i) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / circle_sides;
    return centre_m + u * std::cos(angle) + v * std::sin(angle);
  };
  for (int i = 0; i < circle_sides; ++i) line(at(i), at(i + 1), colour);
}

void LineList::shape(const Shape& shape, LineColour colour) {
  const auto ball = [&](glm::vec3 centre_m) {
    circle(centre_m, {1.0F, 0.0F, 0.0F}, shape.radius_m, colour);
    circle(centre_m, {0.0F, 1.0F, 0.0F}, shape.radius_m, colour);
    circle(centre_m, {0.0F, 0.0F, 1.0F}, shape.radius_m, colour);
  };
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::crater:
      return ball(shape.a);
    case ShapeKind::box:
      return box(shape.a - shape.b, shape.a + shape.b, colour);
    case ShapeKind::capsule:
      ball(shape.a);
      if (shape.a == shape.b) return;
      ball(shape.b);
      return tube(shape.a, shape.b, shape.radius_m, colour);
  }
  CHECK(is_known(shape.kind));
}

void LineList::tube(glm::vec3 from_m, glm::vec3 to_m, float radius_m, LineColour colour) {
  const glm::vec3 axis = glm::normalize(to_m - from_m);
  const glm::vec3 u = across(axis) * radius_m;
  const glm::vec3 v = glm::cross(axis, u);
  for (const glm::vec3 side : {u, v, -u, -v}) line(from_m + side, to_m + side, colour);
  for (const glm::vec3 end_m : {from_m, to_m}) circle(end_m, axis, radius_m, colour);
}

void LineList::cylinder(glm::vec3 from_m, glm::vec3 to_m, float radius_m, int sides, LineColour colour) {
  const glm::vec3 way_m = to_m - from_m;
  const float length_m = glm::length(way_m);
  if (length_m < 1e-5F) return;
  const glm::vec3 u = across(way_m / length_m);
  const glm::vec3 v = glm::cross(way_m / length_m, u);
  const auto around = [&](float side) {
    const float angle = 2.0F * std::numbers::pi_v<float> * side / static_cast<float>(sides);
    return u * std::cos(angle) + v * std::sin(angle);
  };
  for (int i = 0; i < sides; ++i) {
    const auto side = static_cast<float>(i);
    const LineColour seen = shaded(colour, around(side + 0.5F));
    const glm::vec3 one_m = around(side) * radius_m, next_m = around(side + 1.0F) * radius_m;
    triangle(from_m + one_m, to_m + one_m, to_m + next_m, seen);
    triangle(from_m + one_m, to_m + next_m, from_m + next_m, seen);
  }
}

void LineList::cross(glm::vec3 place_m, float half_m, LineColour colour) {
  for (const glm::vec3 axis : {glm::vec3(half_m, 0, 0), glm::vec3(0, half_m, 0), glm::vec3(0, 0, half_m)})
    line(place_m - axis, place_m + axis, colour);
}

}  // namespace scree
