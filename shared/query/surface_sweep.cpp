#include "shared/query/surface_sweep.h"

#include <algorithm>
#include <cmath>

#include "shared/query/quads_near.h"

namespace scree {

namespace {

/// Length of the parts into which a way is divided, voxels.
constexpr double way_part = 8.0;

Corners corners_of(const SurfaceTriangle& triangle) {
  return {in_voxels(triangle[0]), in_voxels(triangle[1]), in_voxels(triangle[2])};
}

glm::dvec3 normal_of(const Corners& corners) {
  const glm::dvec3 out = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  return glm::dot(out, out) > 0.0 ? unit_of(out) : glm::dvec3(0.0);
}

/// Owners of the quads that a segment may touch within a distance.
VoxelBox owners_near(const glm::dvec3& from, const glm::dvec3& to, double reach) {
  constexpr double rounding = 1e-6;
  return owners_of_quads_in(glm::min(from, to) - (reach + rounding), glm::max(from, to) + (reach + rounding));
}

/// Whether a place lies within a distance of a segment.
bool is_near_segment(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b, double distance) {
  const glm::dvec3 off = place - nearest_on_segment(place, a, b);
  return glm::dot(off, off) <= distance * distance;
}

/// How far a triangle's corners are from a place.
double reach_of(const Corners& corners, const glm::dvec3& place) {
  double most = 0.0;
  for (const glm::dvec3& corner : corners) most = std::max(most, glm::dot(corner - place, corner - place));
  return std::sqrt(most);
}

/// The mover's triangle of first touch, and when.
struct Touch {
  double along = 0.0;
  Corners corners;
};

std::optional<Touch> first_touch(CellSource& cells, const Mover& mover, double most, uint32_t& steps) {
  const Line& line = mover.line;
  const double half_axis = std::sqrt(glm::dot(mover.axis, mover.axis)) * 0.5;
  const double reach = half_axis + mover.radius;
  const glm::dvec3 middle = mover.axis * 0.5;
  std::optional<Touch> best;
  VoxelBox done;
  const auto range = line_within(cells.bounds(), 2.0 * reach, line, most);
  if (!range) return best;
  for (double along = range->first; along <= range->second && (!best || best->along >= along);
       along += way_part) {
    const double end = std::min(along + way_part, range->second);
    const glm::dvec3 a = line.at(along), b = line.at(end);
    const VoxelBox owners =
        hull_of(owners_near(a, a + mover.axis, mover.radius), owners_near(b, b + mover.axis, mover.radius));
    const glm::dvec3 last = line.at(best ? best->along : most);
    const auto is_near = [&](const glm::dvec3& place, double size) {
      return is_near_segment(place, line.from + middle, last + middle, reach + size + 1e-6);
    };
    for_each_quad(cells, owners, done, steps, is_near, [&](const SurfaceQuad& quad) {
      for (const SurfaceTriangle& triangle : quad) {
        const Corners corners = corners_of(triangle);
        const glm::dvec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        if (!is_near(centre, reach_of(corners, centre))) continue;
        steps += half_axis > 0.0 ? 4 : 1;
        const auto touch =
            touch_of_capsule(line, mover.axis, best ? best->along : most, mover.radius, corners);
        if (touch && (!best || *touch < best->along)) best = Touch{*touch, corners};
      }
      return true;
    });
    done = owners;
  }
  return best;
}

SweptHit inside_at(const Mover& mover) {
  return {{0.0, mover.line.from, -mover.line.unit}, true};
}

}  // namespace

std::optional<SurfaceNear> nearest_of_surface(CellSource& cells, const glm::dvec3& from,
                                              const glm::dvec3& axis, double most, uint32_t& steps) {
  std::optional<SurfaceNear> best;
  const double half = std::sqrt(glm::dot(axis, axis)) * 0.5;
  const glm::dvec3 middle = from + axis * 0.5;
  double within = most;
  VoxelBox done;
  for (double reach = std::min(most, 2.0);; reach = std::min(most, reach * 2.0)) {
    const VoxelBox owners = owners_near(from, from + axis, reach);
    const auto is_near = [&](const glm::dvec3& place, double size) {
      return is_near_segment(place, middle, middle, half + within + size);
    };
    for_each_quad(cells, owners, done, steps, is_near, [&](const SurfaceQuad& quad) {
      for (const SurfaceTriangle& triangle : quad) {
        const Corners corners = corners_of(triangle);
        const NearPair pair = nearest_of_segment_and_triangle(from, from + axis, corners);
        if (pair.squared > within * within || (best && pair.squared >= best->pair.squared)) continue;
        best = SurfaceNear{pair, normal_of(corners)};
        within = std::min(within, std::sqrt(pair.squared));
      }
      return true;
    });
    if (reach >= most || within <= reach) return best;
    done = owners;
  }
}

bool meets_surface(CellSource& cells, const Rounded& hull, uint32_t& steps) {
  glm::dvec3 lo = hull.points[0], hi = lo;
  for (const glm::dvec3& point : hull.points) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  lo -= hull.radius;
  hi += hull.radius;
  bool found = false;
  const auto everywhere = [](const glm::dvec3&, double) { return true; };
  for_each_quad(cells, owners_of_quads_in(lo, hi), {}, steps, everywhere, [&](const SurfaceQuad& quad) {
    for (const SurfaceTriangle& triangle : quad) {
      const Corners corners = corners_of(triangle);
      const ConvexNear near = nearest_of_convex(hull, {corners, 0.0}, steps);
      found = found || near.meet || near.gap <= 0.0;
    }
    return !found;
  });
  return found;
}

std::optional<SweptHit> first_of_mover(CellSource& cells, const Mover& mover, double most, uint32_t& steps) {
  Mover light = mover;
  const auto near = nearest_of_surface(cells, mover.line.from, mover.axis, mover.radius, steps);
  if (near) {
    const double gap = std::sqrt(near->pair.squared);
    if (gap < mover.radius - touch_slack) return inside_at(mover);
    light.radius = std::min(mover.radius, gap * (1.0 - 1e-9));
  }
  if (is_in_rock(cells, mover.line.from, steps)) return inside_at(mover);
  const auto touch = first_touch(cells, light, most, steps);
  if (!touch) return std::nullopt;
  const glm::dvec3 at = mover.line.at(touch->along);
  const NearPair pair = nearest_of_segment_and_triangle(at, at + mover.axis, touch->corners);
  SweptHit found{{touch->along, pair.on_second, -mover.line.unit}};
  if (pair.squared > 0.0) found.hit.normal = unit_of(pair.on_first - pair.on_second);
  return found;
}

}  // namespace scree
