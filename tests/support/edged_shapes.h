// Bodies of flat faces whose edges are known: a cube, a wedge, a stair, the reveal of a window. Voxels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "shared/field/window.h"

namespace scree {

struct EdgedShape {
  std::string name;
  std::function<float(glm::vec3)> distance;     ///< exact; below 0 inside
  std::vector<std::array<glm::vec3, 2>> edges;  ///< from and to, a voxel short of the corners
};

inline float box_distance(glm::vec3 p, glm::vec3 half) {
  const glm::vec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::vec3(0.0F))) + std::min(std::max({q.x, q.y, q.z}), 0.0F);
}

/// To a polygon in the plane of x and y, which goes on along z; its corners counter-clockwise.
inline float prism_distance(glm::vec3 p, const std::vector<glm::vec2>& corners) {
  const glm::vec2 at(p.x, p.y);
  float squared = 1e9F;
  bool inside = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const glm::vec2 side = corners[j] - corners[i], from = at - corners[i];
    const glm::vec2 away = from - side * std::clamp(glm::dot(from, side) / glm::dot(side, side), 0.0F, 1.0F);
    squared = std::min(squared, glm::dot(away, away));
    const bool below = at.y >= corners[i].y, above = at.y < corners[j].y;
    const bool left = side.x * from.y > side.y * from.x;
    if ((below && above && left) || (!below && !above && !left)) inside = !inside;
  }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

inline EdgedShape cube_shape() {
  constexpr float half = 6.3F, end = half - 1.0F;
  EdgedShape shape{"cube", [](glm::vec3 p) { return box_distance(p, glm::vec3(half)); }, {}};
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      glm::vec3 from(0.0F);
      from[(axis + 1) % 3] = (side & 1) != 0 ? half : -half;
      from[(axis + 2) % 3] = (side & 2) != 0 ? half : -half;
      glm::vec3 to = from;
      from[axis] = -end;
      to[axis] = end;
      shape.edges.push_back({from, to});
    }
  return shape;
}

inline EdgedShape wedge_shape(float degrees) {
  const float rise = 12.0F * std::tan(degrees * 0.5F * 0.01745329252F);
  const std::vector<glm::vec2> corners{{-6.0F, -rise}, {6.0F, 0.0F}, {-6.0F, rise}};
  return {"wedge",
          [corners](glm::vec3 p) { return std::max(prism_distance(p, corners), std::abs(p.z) - 6.0F); },
          {{glm::vec3(6.0F, 0.0F, -4.0F), glm::vec3(6.0F, 0.0F, 4.0F)}}};
}

inline EdgedShape stair_shape() {
  const std::vector<glm::vec2> corners{{-7, -7},  {7, -7}, {7, -3.5F}, {2.5F, -3.5F},
                                       {2.5F, 1}, {-2, 1}, {-2, 5.5F}, {-7, 5.5F}};
  EdgedShape shape{
      "stair",
      [corners](glm::vec3 p) { return std::max(prism_distance(p, corners), std::abs(p.z) - 6.0F); },
      {}};
  for (const glm::vec2 at : {corners[2], corners[3], corners[4], corners[5], corners[6]})
    shape.edges.push_back({glm::vec3(at, -4.0F), glm::vec3(at, 4.0F)});
  return shape;
}

/// A hole of 1.75 m in a wall of 1 m, at voxels of 0.25 m.
inline EdgedShape window_shape() {
  constexpr float half = 3.5F, deep = 2.0F, end = half - 1.0F;
  EdgedShape shape{
      "window",
      [](glm::vec3 p) {
        return std::max(box_distance(p, {8.0F, 8.0F, deep}), -box_distance(p, {half, half, 30.0F}));
      },
      {}};
  for (const float z : {-deep, deep})
    for (const float at : {-half, half}) {
      shape.edges.push_back({glm::vec3(at, -end, z), glm::vec3(at, end, z)});
      shape.edges.push_back({glm::vec3(-end, at, z), glm::vec3(end, at, z)});
    }
  return shape;
}

inline std::vector<EdgedShape> edged_shapes() {
  return {cube_shape(), wedge_shape(30.0F), wedge_shape(60.0F), stair_shape(), window_shape()};
}

/// One of eight ways to turn and shift a shape.
struct ShapePlace {
  glm::quat turn;
  glm::vec3 shift;

  glm::vec3 out(glm::vec3 p) const { return turn * p + shift; }
  glm::vec3 in(glm::vec3 p) const { return glm::inverse(turn) * (p - shift); }
};

inline ShapePlace shape_place(int i) {
  const auto by = static_cast<float>(i);
  const glm::vec3 axis(0.31F + 0.21F * by, 0.83F - 0.15F * by, 0.46F);
  return {glm::angleAxis(i == 0 ? 0.0F : 0.61F + 0.3F * by, glm::normalize(axis)),
          glm::vec3(0.21F, 0.37F, 0.11F) + 0.13F * by};
}

/// Its codes within 14 voxels of `centre`.
inline Window codes_of(const EdgedShape& shape, const ShapePlace& place, VoxelCoord centre = {}) {
  constexpr int reach = 16;
  Window window(VoxelBox{centre, centre}.grown(reach));
  for (int x = -reach; x < reach; ++x)
    for (int y = -reach; y < reach; ++y)
      for (int z = -reach; z < reach; ++z)
        window.at(centre.x + x, centre.y + y, centre.z + z) =
            encode(shape.distance(place.in(glm::vec3(x, y, z))));
  return window;
}

}  // namespace scree
