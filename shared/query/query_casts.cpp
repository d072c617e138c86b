// Casts of rays, spheres and capsules.
#include "shared/query/asked_solids.h"
#include "shared/query/query_check.h"
#include "shared/query/surface_sweep.h"
#include "shared/query/vectors.h"

namespace scree {

Material material_under(const QueryScene& scene, const glm::dvec3& place_m, const glm::dvec3& normal) {
  return material_at(scene.field(), glm::vec3(place_m - normal * (scene.voxel_m() * 0.5)));
}

Material material_under(const Volume& volume, const glm::dvec3& place, const glm::dvec3& normal) {
  const glm::dvec3 at = place - normal * 0.5 + 0.5;
  const VoxelBox& box = volume.window.box;
  const VoxelCoord voxel{std::clamp(floor_to_int(at.x), box.lo.x, box.hi.x - 1),
                         std::clamp(floor_to_int(at.y), box.lo.y, box.hi.y - 1),
                         std::clamp(floor_to_int(at.z), box.lo.z, box.hi.z - 1)};
  return material_near(volume.window, volume.materials, voxel);
}

namespace {

/// So much beyond the best one a solid may be hit and yet be as near, units of its frame: rounding.
constexpr double as_near = 1e-9;
/// Where bodies are, metres.
constexpr double body_slack_m = 1.0 / 65536.0;

/// One cast: its mover in metres; a radius of 0 makes it a ray.
class Caster {
 public:
  Caster(const QueryScene& scene, const Mover& mover_m, double most_m, const QueryMask& mask)
      : scene_(scene), mover_(mover_m), most_m_(most_m), mask_(mask) {}

  Answered<std::optional<Hit>> run() {
    scene_.terrain().begin();
    if (mask_.terrain) cast_at_terrain();
    const glm::dvec3 shrunk = glm::min(mover_.axis, glm::dvec3(0.0)),
                     more = glm::max(mover_.axis, glm::dvec3(0.0));
    const auto is_on_way = [&](const SpaceBox& box) {
      const double reach = mover_.radius + body_slack_m;
      return passes({box.lo - more - reach, box.hi - shrunk + reach}, mover_.line.from,
                    mover_.line.at(most()));
    };
    for_each_asked(scene_, mask_, steps_, is_on_way, [&](size_t index, const QuerySolid& solid) {
      if (solid.volume != nullptr)
        cast_at_piece(index, solid);
      else
        cast_at_body(index, solid);
    });
    if (best_) add_material();
    return {best_, cost_of(scene_, steps_)};
  }

 private:
  double most() const { return best_ ? best_along_m_ : most_m_; }

  Mover in_frame(const SolidFrame& frame) const {
    return {{frame.in(mover_.line.from), frame.turned_in(mover_.line.unit)},
            frame.turned_in(mover_.axis) / frame.unit_m,
            mover_.radius / frame.unit_m};
  }

  void take(HitKind kind, PieceId id, double along_m, const glm::dvec3& place_m, const glm::dvec3& normal,
            bool inside) {
    if (best_ && along_m > best_along_m_) return;
    if (best_ && along_m == best_along_m_ && (best_->kind == HitKind::terrain || best_->id <= id)) return;
    if (along_m > most_m_) return;
    best_along_m_ = along_m;
    normal_ = normal;
    place_m_ = place_m;
    best_ = Hit{kind, id, static_cast<float>(along_m), glm::vec3(place_m), glm::vec3(normal)};
    best_->inside = inside;
  }
  void take_inside(HitKind kind, PieceId id) {
    take(kind, id, 0.0, mover_.line.from, -mover_.line.unit, true);
  }

  /// Where polygons are, in a frame of voxels.
  std::optional<SweptHit> first_of_polygons(CellSource& cells, const Mover& mover, double most) {
    if (mover.radius > 0.0) return first_of_mover(cells, mover, most, steps_);
    if (is_in_rock(cells, mover.line.from, steps_)) return SweptHit{{}, true};
    const auto hit = first_on_line(cells, mover.line, most, steps_);
    if (!hit) return std::nullopt;
    // Away from the rock, also where a fold of the surface shows its back.
    const bool is_back = glm::dot(hit->normal, mover.line.unit) > 0.0;
    return SweptHit{{hit->along, hit->place, is_back ? -hit->normal : hit->normal}, false};
  }

  void cast_at_terrain() {
    SolidFrame frame;
    frame.unit_m = scene_.voxel_m();
    const auto found = first_of_polygons(scene_.terrain(), in_frame(frame), most_m_ / frame.unit_m + as_near);
    if (!found) return;
    if (found->inside) return take_inside(HitKind::terrain, 0);
    take(HitKind::terrain, 0, found->hit.along * frame.unit_m, frame.out(found->hit.place), found->hit.normal,
         false);
  }

  void cast_at_piece(size_t index, const QuerySolid& solid) {
    const SolidFrame& frame = scene_.frame(index);
    const auto found =
        first_of_polygons(scene_.cells(index), in_frame(frame), most() / frame.unit_m + as_near);
    if (!found) return;
    if (found->inside) return take_inside(HitKind::piece, solid.id);
    take(HitKind::piece, solid.id, found->hit.along * frame.unit_m, frame.out(found->hit.place),
         frame.turned_out(found->hit.normal), false);
  }

  void cast_at_body(size_t index, const QuerySolid& solid) {
    const SolidFrame& frame = scene_.frame(index);
    const Mover mover = in_frame(frame);
    const std::array<glm::dvec3, 2> ends{mover.line.from, mover.line.from + mover.axis};
    const bool is_long = mover.axis != glm::dvec3(0.0);
    const Rounded moving{{ends.data(), is_long ? size_t{2} : size_t{1}}, mover.radius};
    for (const Convex& part : solid.parts) {
      const PartPoints points(part);
      const auto hit =
          first_of_convex(moving, mover.line.unit, most() + as_near, points.rounded(), body_slack_m, steps_);
      if (!hit) continue;
      if (hit->inside) return take_inside(HitKind::body, solid.id);
      take(HitKind::body, solid.id, hit->along, frame.out(hit->place), frame.turned_out(hit->normal), false);
    }
  }

  void add_material() {
    const glm::dvec3 normal = best_->inside ? glm::dvec3(0.0) : normal_;
    if (best_->kind == HitKind::terrain) best_->material = material_under(scene_, place_m_, normal);
    if (best_->kind != HitKind::piece) return;
    const auto solids = scene_.solids();
    const auto found = std::lower_bound(solids.begin(), solids.end(), best_->id,
                                        [](const QuerySolid& solid, PieceId id) { return solid.id < id; });
    const SolidFrame& frame = scene_.frame(static_cast<size_t>(found - solids.begin()));
    best_->material = material_under(*found->volume, frame.in(place_m_), frame.turned_in(normal));
  }

  const QueryScene& scene_;
  const Mover mover_;
  const double most_m_;
  const QueryMask& mask_;
  uint32_t steps_ = 0;
  std::optional<Hit> best_;
  double best_along_m_ = 0.0;
  glm::dvec3 place_m_{0.0}, normal_{0.0};  ///< of the best one
};

Line line_of(glm::vec3 from_m, glm::vec3 unit) {
  return {glm::dvec3(from_m), unit_of(glm::dvec3(unit))};
}

}  // namespace

QueryResult<std::optional<Hit>> cast_ray(const QueryScene& scene, glm::vec3 from_m, glm::vec3 unit,
                                         float most_m, const QueryMask& mask) {
  TRY(check_place(from_m));
  TRY(check_way(unit, most_m));
  TRY(check_mask(mask));
  const Mover mover{line_of(from_m, unit), glm::dvec3(0.0), 0.0};
  return Caster(scene, mover, static_cast<double>(most_m), mask).run();
}

QueryResult<std::optional<Hit>> cast_sphere(const QueryScene& scene, glm::vec3 from_m, glm::vec3 unit,
                                            float most_m, float radius_m, const QueryMask& mask) {
  return cast_capsule(scene, from_m, from_m, unit, most_m, radius_m, mask);
}

QueryResult<std::optional<Hit>> cast_capsule(const QueryScene& scene, glm::vec3 a_m, glm::vec3 b_m,
                                             glm::vec3 unit, float most_m, float radius_m,
                                             const QueryMask& mask) {
  TRY(check_place(a_m));
  TRY(check_place(b_m));
  TRY(check_way(unit, most_m));
  TRY(check_mover(b_m - a_m, radius_m, most_m));
  TRY(check_mask(mask));
  const Mover mover{line_of(a_m, unit), glm::dvec3(b_m) - glm::dvec3(a_m), static_cast<double>(radius_m)};
  return Caster(scene, mover, static_cast<double>(most_m), mask).run();
}

}  // namespace scree
