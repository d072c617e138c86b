// Overlaps, the nearest surface, and whether a place is solid.
#include <cmath>

#include "shared/query/asked_solids.h"
#include "shared/query/query_check.h"
#include "shared/query/surface_sweep.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

bool holds(const SpaceBox& box, const glm::dvec3& place) {
  return box.meets({place, place});
}

bool is_in_part(const glm::dvec3& place, const Convex& part, double radius, uint32_t& steps) {
  const PartPoints points(part);
  const ConvexNear near = nearest_of_convex(place, points.rounded(), steps);
  return near.meet || near.gap <= radius;
}

/// Whether polygons, or the rock within them, have a place within a ball.
bool overlaps_ball(CellSource& cells, const glm::dvec3& centre, double radius, uint32_t& steps) {
  return is_in_rock(cells, centre, steps) ||
         nearest_of_surface(cells, centre, glm::dvec3(0.0), radius, steps).has_value();
}

std::array<glm::dvec3, 8> corners_of_box(const SpaceBox& box) {
  std::array<glm::dvec3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 4U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                  (i & 1U) != 0 ? box.hi.z : box.lo.z};
  return corners;
}

SolidFrame terrain_frame(const QueryScene& scene) {
  SolidFrame frame;
  frame.unit_m = scene.voxel_m();
  return frame;
}

/// The same of a box in the world.
bool overlaps_box(CellSource& cells, const SpaceBox& box, const SolidFrame& frame, uint32_t& steps) {
  if (is_in_rock(cells, frame.in((box.lo + box.hi) * 0.5), steps)) return true;
  std::array<glm::dvec3, 8> corners = corners_of_box(box);
  for (glm::dvec3& corner : corners) corner = frame.in(corner);
  return meets_surface(cells, {corners, 0.0}, steps);
}

/// Collects the solids near a box that `overlaps(index, solid)`.
template <typename Overlaps>
std::vector<PieceId> ids_near(const QueryScene& scene, const SpaceBox& box, const QueryMask& mask,
                              uint32_t& steps, Overlaps&& overlaps) {
  std::vector<PieceId> ids;
  for_each_asked(
      scene, mask, steps, [&](const SpaceBox& other) { return other.meets(box); },
      [&](size_t index, const QuerySolid& solid) {
        if (overlaps(index, solid)) ids.push_back(solid.id);
      });
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The nearest of all surfaces.
class NearestSurface {
 public:
  NearestSurface(const QueryScene& scene, const glm::dvec3& place_m, double most_m, const QueryMask& mask)
      : scene_(scene), place_m_(place_m), most_m_(most_m), mask_(mask) {}

  Answered<std::optional<Hit>> run() {
    scene_.terrain().begin();
    if (mask_.terrain) {
      const SolidFrame frame = terrain_frame(scene_);
      look_at_polygons(scene_.terrain(), frame, HitKind::terrain, 0);
      if (best_) best_->material = material_under(scene_, on_m_, normal_);
    }
    const auto is_near = [&](const SpaceBox& box) {
      return box.grown(most_m_ + 1e-9).meets({place_m_, place_m_});
    };
    for_each_asked(scene_, mask_, steps_, is_near, [&](size_t index, const QuerySolid& solid) {
      const SolidFrame& frame = scene_.frame(index);
      if (solid.volume == nullptr) return look_at_body(frame, solid);
      if (look_at_polygons(scene_.cells(index), frame, HitKind::piece, solid.id))
        best_->material = material_under(*solid.volume, frame.in(on_m_), frame.turned_in(normal_));
    });
    return {best_, cost_of(scene_, steps_)};
  }

 private:
  bool take(HitKind kind, PieceId id, double distance_m, const glm::dvec3& on_m, const glm::dvec3& normal,
            bool inside) {
    if (distance_m > most_m_) return false;
    if (best_ && distance_m == most_m_ && (best_->kind == HitKind::terrain || best_->id <= id)) return false;
    most_m_ = distance_m;
    on_m_ = on_m;
    normal_ = normal;
    best_ = Hit{kind, id, static_cast<float>(distance_m), glm::vec3(on_m), glm::vec3(normal)};
    best_->inside = inside;
    return true;
  }

  bool look_at_polygons(CellSource& cells, const SolidFrame& frame, HitKind kind, PieceId id) {
    const glm::dvec3 place = frame.in(place_m_);
    const auto near =
        nearest_of_surface(cells, place, glm::dvec3(0.0), most_m_ / frame.unit_m + 1e-9, steps_);
    if (!near) return false;
    const bool inside = is_in_rock(cells, place, steps_);
    const double distance = std::sqrt(near->pair.squared);
    glm::dvec3 normal = near->normal;
    if (distance > 1e-6) normal = (place - near->pair.on_second) / (inside ? -distance : distance);
    if (normal == glm::dvec3(0.0)) normal = {0.0, 1.0, 0.0};
    return take(kind, id, distance * frame.unit_m, frame.out(near->pair.on_second), frame.turned_out(normal),
                inside);
  }

  void look_at_body(const SolidFrame& frame, const QuerySolid& solid) {
    const glm::dvec3 place = frame.in(place_m_);
    for (const Convex& part : solid.parts) {
      const PartPoints points(part);
      const ConvexNear near = nearest_of_convex(place, points.rounded(), steps_);
      if (near.meet || near.gap <= 0.0) {
        const glm::dvec3 normal = near.meet ? glm::dvec3(0.0, 1.0, 0.0) : frame.turned_out(near.normal);
        take(HitKind::body, solid.id, 0.0, place_m_, normal, true);
        return;
      }
      take(HitKind::body, solid.id, near.gap, frame.out(near.on_second), frame.turned_out(near.normal),
           false);
    }
  }

  const QueryScene& scene_;
  const glm::dvec3 place_m_;
  double most_m_;
  const QueryMask& mask_;
  uint32_t steps_ = 0;
  std::optional<Hit> best_;
  glm::dvec3 on_m_{0.0}, normal_{0.0};
};

}  // namespace

QueryResult<Overlapping> overlap_sphere(const QueryScene& scene, glm::vec3 centre_m, float radius_m,
                                        const QueryMask& mask) {
  TRY(check_place(centre_m));
  TRY(check_mover(glm::vec3(0.0F), radius_m, 0.0F));
  TRY(check_mask(mask));
  scene.terrain().begin();
  uint32_t steps = 0;
  const glm::dvec3 centre(centre_m);
  const auto radius = static_cast<double>(radius_m);
  Overlapping found;
  const SolidFrame frame = terrain_frame(scene);
  if (mask.terrain)
    found.terrain = overlaps_ball(scene.terrain(), frame.in(centre), radius / frame.unit_m, steps);
  found.ids = ids_near(
      scene, SpaceBox{centre, centre}.grown(radius), mask, steps, [&](size_t index, const QuerySolid& solid) {
        const SolidFrame& own = scene.frame(index);
        const glm::dvec3 place = own.in(centre);
        if (solid.volume != nullptr)
          return overlaps_ball(scene.cells(index), place, radius / own.unit_m, steps);
        return std::any_of(solid.parts.begin(), solid.parts.end(),
                           [&](const Convex& part) { return is_in_part(place, part, radius, steps); });
      });
  return Answered<Overlapping>{std::move(found), cost_of(scene, steps)};
}

QueryResult<Overlapping> overlap_box(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m,
                                     const QueryMask& mask) {
  TRY(check_volume(lo_m, hi_m));
  TRY(check_mask(mask));
  scene.terrain().begin();
  uint32_t steps = 0;
  const SpaceBox box{glm::dvec3(lo_m), glm::dvec3(hi_m)};
  Overlapping found;
  if (mask.terrain) found.terrain = overlaps_box(scene.terrain(), box, terrain_frame(scene), steps);
  const std::array<glm::dvec3, 8> corners = corners_of_box(box);
  found.ids = ids_near(scene, box, mask, steps, [&](size_t index, const QuerySolid& solid) {
    const SolidFrame& frame = scene.frame(index);
    if (solid.volume != nullptr) return overlaps_box(scene.cells(index), box, frame, steps);
    std::array<glm::dvec3, 8> own = corners;
    for (glm::dvec3& corner : own) corner = frame.in(corner);
    return std::any_of(solid.parts.begin(), solid.parts.end(), [&](const Convex& part) {
      const PartPoints points(part);
      const ConvexNear near = nearest_of_convex(Rounded{own, 0.0}, points.rounded(), steps);
      return near.meet || near.gap <= 0.0;
    });
  });
  return Answered<Overlapping>{std::move(found), cost_of(scene, steps)};
}

QueryResult<std::optional<Hit>> nearest_surface(const QueryScene& scene, glm::vec3 place_m, float most_m,
                                                const QueryMask& mask) {
  TRY(check_nearest(place_m, most_m));
  TRY(check_mask(mask));
  return NearestSurface(scene, glm::dvec3(place_m), static_cast<double>(most_m), mask).run();
}

QueryResult<bool> is_solid(const QueryScene& scene, glm::vec3 place_m, const QueryMask& mask) {
  TRY(check_place(place_m));
  TRY(check_mask(mask));
  scene.terrain().begin();
  uint32_t steps = 0;
  const glm::dvec3 place(place_m);
  bool found = mask.terrain && is_in_rock(scene.terrain(), terrain_frame(scene).in(place), steps);
  const auto is_near = [&](const SpaceBox& box) { return !found && holds(box, place); };
  for_each_asked(scene, mask, steps, is_near, [&](size_t index, const QuerySolid& solid) {
    const glm::dvec3 own = scene.frame(index).in(place);
    if (solid.volume != nullptr)
      found = found || is_in_rock(scene.cells(index), own, steps);
    else
      found = found || std::any_of(solid.parts.begin(), solid.parts.end(),
                                   [&](const Convex& part) { return is_in_part(own, part, 0.0, steps); });
  });
  return Answered<bool>{found, cost_of(scene, steps)};
}

}  // namespace scree
