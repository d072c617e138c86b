#include "server/bodies/prop_body.h"

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "server/bodies/body_shape.h"
#include "server/bodies/limits.h"
#include "shared/base/check.h"
#include "shared/prop/limits.h"
#include "shared/prop/prop_solid.h"

namespace scree {

namespace {

/// Points of a capsule's tube: circles from end to end, of a point every 30 degrees.
void add_tube(const PropPart& part, float spacing_m, std::vector<glm::vec3>& to) {
  constexpr std::array<float, 12> cosines{1.0F,  0.86602540F,  0.5F,  0.0F, -0.5F, -0.86602540F,
                                          -1.0F, -0.86602540F, -0.5F, 0.0F, 0.5F,  0.86602540F};
  const float radius_m = part.half_m.x, half_m = part.half_m.y;
  const int gaps = 1 + static_cast<int>(2.0F * half_m / std::max(spacing_m, radius_m));
  const glm::mat3 turn = glm::mat3_cast(part.turn);
  for (int circle = 0; circle <= gaps; ++circle)
    for (size_t step = 0; step < cosines.size(); ++step) {
      const float along_m = half_m * (2.0F * static_cast<float>(circle) / static_cast<float>(gaps) - 1.0F);
      const float cosine = cosines[step], sine = cosines[(step + 9) % cosines.size()];
      to.push_back(part.place_m + turn * glm::vec3(radius_m * cosine, along_m, radius_m * sine));
    }
}

/// The points of a part by which it touches the terrain.
std::vector<glm::vec3> touching_points(const PropPart& part, float spacing_m) {
  std::vector<glm::vec3> points = outline_of(part);
  if (part.kind == PropPartKind::capsule) {
    add_tube(part, spacing_m, points);
  } else if (part.kind != PropPartKind::sphere) {
    points = surface_points(points, spacing_m);
  }
  return points;
}

}  // namespace

BodyShape body_shape_of(const Prop& prop, const PropMeasure& measure, float density_kg_m3, float spacing_m) {
  CHECK_DEBUG(validate(prop).has_value());
  CHECK(density_kg_m3 > 0.0F && spacing_m > 0.0F);
  CHECK(measure.volume_m3 > 0.0F);
  BodyShape shape;
  shape.mass_kg = std::clamp(prop.mass_kg > 0.0F ? prop.mass_kg : density_kg_m3 * measure.volume_m3,
                             limits::prop_mass_min_kg, limits::prop_mass_max_kg);
  shape.inertia_kg_m2 = measure.inertia_m5 * (shape.mass_kg / measure.volume_m3);
  shape.centre_m = measure.middle_m;
  shape.friction = prop.friction;
  shape.restitution = prop.restitution;
  shape.nature = {prop.motion, prop.drag, prop.spin_drag, prop.gravity, prop.groups, prop.meets};
  const auto from_mass = [&](std::vector<glm::vec3> points) {
    for (glm::vec3& p : points) p -= shape.centre_m;
    return points;
  };
  bool is_rounded = false;
  for (const PropPart& part : prop.parts) {
    const std::vector<glm::vec3> outline = from_mass(outline_of(part)),
                                 touching = from_mass(touching_points(part, spacing_m));
    shape.hull_m.insert(shape.hull_m.end(), outline.begin(), outline.end());
    shape.surface_m.insert(shape.surface_m.end(), touching.begin(), touching.end());
    RoundedHull hull = rounded_hull_of(part);
    is_rounded = is_rounded || hull.radius_m > 0.0F;
    shape.parts_m.push_back(from_mass(std::move(hull.points_m)));
    shape.part_radii_m.push_back(hull.radius_m);
  }
  if (!is_rounded) shape.part_radii_m.clear();
  return shape;
}

}  // namespace scree
