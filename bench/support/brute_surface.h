// A surface as all triangles of its mesh, and what a ray or a ball meets of it, found by looking at every
// triangle near: the reference for shared/query, of which it shares no code. Units: voxels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <vector>

#include "shared/field/field.h"
#include "shared/surface/surface_nets.h"

namespace scree {

class BruteSurface {
 public:
  using Corners = std::array<glm::dvec3, 3>;

  void add(const SurfaceMesh& mesh) {
    const glm::dvec3 origin(mesh.origin.x, mesh.origin.y, mesh.origin.z);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      Corners corners;
      for (size_t k = 0; k < 3; ++k) {
        const auto& p = mesh.vertices[mesh.indices[i + k]].position;
        corners[k] = origin + glm::dvec3(p[0], p[1], p[2]) / static_cast<double>(surface_steps);
      }
      add(corners);
    }
  }
  /// The mesh that is exported and drawn, chunk by chunk.
  void add_field(const Field& field, const VoxelBox& box) {
    for_each_chunk(box, [&](ChunkCoord chunk) {
      const VoxelCoord first = first_voxel(chunk);
      const VoxelBox owned{first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}};
      add(surface_nets(gather(field, owned.grown(surface_nets_apron)), owned));
    });
  }
  size_t triangles() const { return count_; }

  /// How far along the ray the first triangle is, of either side (Möller and Trumbore 1997).
  std::optional<double> first_on_line(glm::dvec3 from, glm::dvec3 unit, double most) const {
    double best = most;
    bool found = false;
    for (const auto& [at, group] : groups_) {
      if (!passes(group, from, unit, best)) continue;
      for (const Corners& corners : group.triangles) {
        const auto along = along_line(corners, from, unit);
        if (!along || *along < 0.0 || *along > best) continue;
        best = *along;
        found = true;
      }
    }
    return found ? std::optional(best) : std::nullopt;
  }

  /// Distance of a segment of that axis to the surface, `most` at most.
  double distance(glm::dvec3 from, glm::dvec3 axis, double most) const {
    double best = most;
    const bool is_long = glm::dot(axis, axis) > 0.0;
    if (is_long) best = distance(from + axis * 0.5, glm::dvec3(0.0), most);
    for (const auto& [at, group] : groups_) {
      const glm::dvec3 lo = glm::min(from, from + axis) - best, hi = glm::max(from, from + axis) + best;
      if (!meets(lo, hi, group.lo, group.hi)) continue;
      for (const Corners& corners : group.triangles) {
        const glm::dvec3 least = glm::min(glm::min(corners[0], corners[1]), corners[2]);
        const glm::dvec3 top = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        if (meets(lo, hi, least, top)) best = std::min(best, distance_to_segment(corners, from, axis));
      }
    }
    return best;
  }

  /// How far a capsule moves until it touches the surface, by steps of its distance.
  std::optional<double> first_of_capsule(glm::dvec3 from, glm::dvec3 axis, glm::dvec3 unit, double most,
                                         double radius) const {
    for (double along = 0.0; along <= most;) {
      const double gap = distance(from + unit * along, axis, 8.0 + radius) - radius;
      if (gap < 1e-4) return along;
      along += gap;
    }
    return std::nullopt;
  }

  /// Whether a triangle has a place within a box: by looking at places of the triangle, `spacing` apart.
  bool has_place_in(glm::dvec3 lo, glm::dvec3 hi, double spacing) const {
    for (const auto& [at, group] : groups_) {
      if (!meets(lo, hi, group.lo, group.hi)) continue;
      for (const auto& [a, b, c] : group.triangles) {
        const int steps = 1 + static_cast<int>(std::max(glm::length(b - a), glm::length(c - a)) / spacing);
        for (int i = 0; i <= steps; ++i)
          for (int k = 0; k + i <= steps; ++k) {
            const glm::dvec3 p = a + (b - a) * (i / double(steps)) + (c - a) * (k / double(steps));
            if (meets(lo, hi, p, p)) return true;
          }
      }
    }
    return false;
  }

 private:
  static constexpr int group_side = 8;
  struct Group {
    glm::dvec3 lo{1e9}, hi{-1e9};
    std::vector<Corners> triangles;
  };

  void add(const Corners& corners) {
    const auto place = [](double x) { return static_cast<int>(std::floor(x / group_side)); };
    Group& group = groups_[{place(corners[0].x), place(corners[0].y), place(corners[0].z)}];
    for (const glm::dvec3& corner : corners) {
      group.lo = glm::min(group.lo, corner);
      group.hi = glm::max(group.hi, corner);
    }
    group.triangles.push_back(corners);
    ++count_;
  }
  static bool meets(glm::dvec3 lo, glm::dvec3 hi, glm::dvec3 other_lo, glm::dvec3 other_hi) {
    return lo.x <= other_hi.x && lo.y <= other_hi.y && lo.z <= other_hi.z && hi.x >= other_lo.x &&
           hi.y >= other_lo.y && hi.z >= other_lo.z;
  }
  static bool passes(const Group& group, glm::dvec3 from, glm::dvec3 unit, double most) {
    double lo = 0.0, hi = most;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(unit[i]) < 1e-12) {
        if (from[i] < group.lo[i] - 1e-6 || from[i] > group.hi[i] + 1e-6) return false;
        continue;
      }
      const double a = (group.lo[i] - 1e-6 - from[i]) / unit[i], b = (group.hi[i] + 1e-6 - from[i]) / unit[i];
      lo = std::max(lo, std::min(a, b));
      hi = std::min(hi, std::max(a, b));
    }
    return lo <= hi;
  }
  static std::optional<double> along_line(const Corners& corners, glm::dvec3 from, glm::dvec3 unit) {
    constexpr double slack = 1e-7;
    const glm::dvec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(unit, ac);
    const double scale = glm::dot(ab, p);
    if (std::abs(scale) < 1e-12) return std::nullopt;
    const glm::dvec3 off = from - corners[0], q = glm::cross(off, ab);
    const double u = glm::dot(off, p) / scale, v = glm::dot(unit, q) / scale;
    if (u < -slack || v < -slack || u + v > 1.0 + slack) return std::nullopt;
    return glm::dot(ac, q) / scale;
  }
  static double distance_to_edge(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
    const double squared = glm::dot(b - a, b - a);
    const double part = squared > 0.0 ? std::clamp(glm::dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0;
    return glm::length(p - a - (b - a) * part);
  }
  static double distance_to_place(const Corners& corners, glm::dvec3 p) {
    const auto& [a, b, c] = corners;
    double best = std::min({distance_to_edge(p, a, b), distance_to_edge(p, b, c), distance_to_edge(p, c, a)});
    const glm::dvec3 out = glm::cross(b - a, c - a);
    const double size = glm::length(out);
    if (size == 0.0) return best;
    const bool within = glm::dot(glm::cross(b - a, p - a), out) >= 0.0 &&
                        glm::dot(glm::cross(c - b, p - b), out) >= 0.0 &&
                        glm::dot(glm::cross(a - c, p - c), out) >= 0.0;
    return within ? std::min(best, std::abs(glm::dot(p - a, out)) / size) : best;
  }
  /// The distance is convex along the segment: the third with the larger end is left out, again and again.
  static double distance_to_segment(const Corners& corners, glm::dvec3 from, glm::dvec3 axis) {
    if (glm::dot(axis, axis) == 0.0) return distance_to_place(corners, from);
    double lo = 0.0, hi = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double a = lo + (hi - lo) / 3.0, b = hi - (hi - lo) / 3.0;
      if (distance_to_place(corners, from + axis * a) < distance_to_place(corners, from + axis * b))
        hi = b;
      else
        lo = a;
    }
    return distance_to_place(corners, from + axis * ((lo + hi) * 0.5));
  }

  std::map<std::array<int, 3>, Group> groups_;
  size_t count_ = 0;
};

}  // namespace scree
