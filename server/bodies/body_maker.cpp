#include "server/bodies/body_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/bodies/body_shape.h"
#include "server/bodies/limits.h"
#include "server/bodies/principal_axes.h"

namespace scree {

namespace {

btVector3 stable_inertia(glm::vec3 moments) {
  const float least = std::max({moments.x, moments.y, moments.z}) * limits::inertia_ratio_min;
  return to_bullet(glm::max(moments, glm::vec3(least)));
}

std::vector<glm::vec3> turned(std::vector<glm::vec3> points, glm::quat rotation) {
  const glm::mat3 matrix = glm::mat3_cast(rotation);
  for (glm::vec3& p : points) p = matrix * p;
  return points;
}

/// The shape in axes that `axes` turns into its own.
BodyShape in_axes(const BodyShape& shape, glm::quat axes) {
  const glm::quat back = glm::conjugate(axes);
  BodyShape result = shape;
  result.hull_m = turned(std::move(result.hull_m), back);
  result.surface_m = turned(std::move(result.surface_m), back);
  for (std::vector<glm::vec3>& part : result.parts_m) part = turned(std::move(part), back);
  return result;
}

glm::vec3 middle_of(const std::vector<glm::vec3>& points) {
  glm::vec3 sum(0.0F);
  for (const glm::vec3& p : points) sum += p;
  return sum / static_cast<float>(points.size());
}

/// Makes the shapes that collide with other bodies.
void add_hulls(const BodyShape& shape, Body& body) {
  body.hulls = std::make_unique<CollisionHulls>();
  body.hulls->meets_by_faces = !shape.nature.is_piece();
  const float gap_m = shape.nature.is_piece() ? limits::birth_gap_m : 0.0F;
  for (size_t i = 0; i < shape.parts_m.size(); ++i) {
    const std::vector<glm::vec3>& part = shape.parts_m[i];
    const float radius_m = shape.part_radii_m.empty() ? 0.0F : shape.part_radii_m[i];
    body.parts.push_back(radius_m > 0.0F ? make_rounded_shape(part, radius_m)
                                         : make_convex_shape(part, middle_of(part), gap_m));
    body.hulls->add(*body.parts.back());
  }
  if (body.parts.empty()) body.hulls->add(*body.shape);
}

}  // namespace

Body make_body(PieceId id, std::shared_ptr<const BodyShape> given, std::vector<glm::vec3> points_m,
               const StepSize& step) {
  const PrincipalAxes principal = principal_axes(given->inertia_kg_m2);
  const BodyShape shape = in_axes(*given, principal.rotation);
  Body body;
  body.given = std::move(given);
  body.axes = principal.rotation;
  body.shape = make_convex_shape(shape.hull_m);
  body.reach_m = radius_of(shape.hull_m);
  body.mass_kg = shape.mass_kg;
  body.inertia_kg_m2 = stable_inertia(principal.moments);
  const bool is_piece = shape.nature.is_piece();
  const float spin_travel_m = (is_piece ? limits::spin_travel_share : limits::prop_spin_travel_share) *
                              limits::travel_max_voxels * step.voxel_size_m / step.step_s;
  const float spin_max = is_piece ? limits::spin_max_rad_s : limits::prop_spin_max_rad_s;
  body.spin_max_rad_s = std::min(spin_max, spin_travel_m / std::max(body.reach_m, 0.01F));
  const bool is_dynamic = body.is_dynamic();
  btRigidBody::btRigidBodyConstructionInfo info(
      is_dynamic ? shape.mass_kg : 0.0F, nullptr, body.shape.get(),
      is_dynamic ? body.inertia_kg_m2 : btVector3(0.0F, 0.0F, 0.0F));
  info.m_friction = std::sqrt(shape.friction);  // Bullet multiplies those of both bodies
  info.m_restitution = std::sqrt(shape.restitution);
  info.m_linearSleepingThreshold = limits::sleep_speed_m_s;
  info.m_angularSleepingThreshold = limits::sleep_spin_rad_s;
  body.rigid = std::make_unique<btRigidBody>(info);
  body.rigid->setFlags(0);  // no gyroscopic torque: it costs a solve a body, and rubble does not show it
  if (shape.nature.motion == PropMotion::kinematic)
    body.rigid->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  add_hulls(shape, body);
  body.rigid->setUserPointer(body.hulls.get());
  body.rigid->setUserIndex(static_cast<int>(id));
  body.touches_by_surface = shape.nature.is_piece() && !shape.surface_m.empty();
  body.points_m = std::move(points_m);
  if (body.points_m.empty())
    body.points_m = shape.surface_m.empty()
                        ? surface_points(shape.hull_m, limits::sample_spacing_voxels * step.voxel_size_m)
                        : shape.surface_m;
  body.round = roundness_of(body.points_m);
  if (body.round.radius_m == 0.0F) body.round = roller_of(shape);
  const bool is_round = body.round.radius_m > 0.0F;
  const float rolls_by_m = body.round.is_roller() ? body.round.radius_m : body.reach_m;
  body.hulls->rolling = {(is_round ? limits::rolling_share_round : limits::rolling_share) * rolls_by_m,
                         limits::turning_share * body.reach_m};
  return body;
}

}  // namespace scree
