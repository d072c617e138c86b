// Bodies from their shapes, and from the exact motions that other bodies had.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "server/bodies/bodies_state.h"
#include "server/bodies/body_shape.h"
#include "server/bodies/limits.h"
#include "server/bodies/principal_axes.h"
#include "server/bodies/to_bullet.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

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
  for (const std::vector<glm::vec3>& part : shape.parts_m) {
    body.parts.push_back(make_convex_shape(part, middle_of(part)));
    body.hulls->add(*body.parts.back());
  }
  if (body.parts.empty()) body.hulls->add(*body.shape);
}

/// Speeds that were cut to their limit differ from it by rounding.
constexpr float rounding = 1.001F;

Result<void> refuse(PieceId id, const char* what) {
  return fail("body " + std::to_string(id) + ": " + what);
}

Result<void> check_shape(PieceId id, const BodyShape& shape) {
  const glm::mat3& inertia = shape.inertia_kg_m2;
  const auto sound = [](const std::vector<glm::vec3>& points) {
    return std::ranges::all_of(points, [](glm::vec3 p) { return is_sound(p); });
  };
  const auto hull = [&](const std::vector<glm::vec3>& points) { return points.size() >= 4 && sound(points); };
  if (!hull(shape.hull_m) || !sound(shape.surface_m) || !std::ranges::all_of(shape.parts_m, hull))
    return refuse(id, "a hull of fewer than four corners, or without a place");
  if (!(shape.mass_kg >= limits::kept_mass_min_kg && shape.mass_kg <= limits::kept_mass_max_kg))
    return refuse(id, "its mass is none that a piece has");
  for (int i = 0; i < 3; ++i)
    if (!is_sound(inertia[i]) || !(inertia[i][i] > 0.0F)) return refuse(id, "its inertia is not positive");
  if (inertia != glm::transpose(inertia)) return refuse(id, "its inertia is not symmetric");
  if (!(shape.friction >= 0.0F) || !std::isfinite(shape.friction))
    return refuse(id, "its friction is negative or no number");
  return {};
}

Result<void> check_motion(const BodyMotion& motion) {
  const auto& rows = motion.basis;
  const auto is_across = [&](int a, int b) {
    return std::abs(glm::dot(rows[static_cast<size_t>(a)], rows[static_cast<size_t>(b)])) < 2e-3F;
  };
  const bool turned = is_unit(rows[0]) && is_unit(rows[1]) && is_unit(rows[2]) && is_across(0, 1) &&
                      is_across(1, 2) && is_across(2, 0) &&
                      glm::dot(glm::cross(rows[0], rows[1]), rows[2]) > 0.0F;
  if (!turned) return refuse(motion.id, "its rotation is none");
  const glm::vec3 at = motion.origin_m;
  if (!(std::abs(at.x) <= limits::world_half_width_m && std::abs(at.y) <= limits::world_half_height_m &&
        std::abs(at.z) <= limits::world_half_width_m))
    return refuse(motion.id, "it lies outside the world");
  if (!is_sound(motion.velocity_m_s) || !is_sound(motion.spin_rad_s))
    return refuse(motion.id, "its speed is no number");
  const bool moves = motion.velocity_m_s != glm::vec3(0.0F) || motion.spin_rad_s != glm::vec3(0.0F);
  if (motion.frozen && (moves || motion.thawed)) return refuse(motion.id, "it is frozen, and moves");
  return {};
}

btTransform transform_of(const BodyMotion& motion) {
  const auto& [x, y, z] = motion.basis;
  return btTransform(btMatrix3x3(x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z), to_bullet(motion.origin_m));
}

}  // namespace

Body& Bodies::State::make(PieceId id, std::shared_ptr<const BodyShape> given,
                          std::vector<glm::vec3> points_m) {
  const PrincipalAxes principal = principal_axes(given->inertia_kg_m2);
  const BodyShape shape = in_axes(*given, principal.rotation);
  Body& body = bodies[id];
  body.given = std::move(given);
  body.axes = principal.rotation;
  body.shape = make_convex_shape(shape.hull_m);
  body.reach_m = radius_of(shape.hull_m);
  body.mass_kg = shape.mass_kg;
  body.inertia_kg_m2 = stable_inertia(principal.moments);
  const float spin_travel_m = 0.2F * limits::travel_max_voxels * voxel_size_m / step_s;
  body.spin_max_rad_s = std::min(limits::spin_max_rad_s, spin_travel_m / std::max(body.reach_m, 0.01F));
  btRigidBody::btRigidBodyConstructionInfo info(shape.mass_kg, nullptr, body.shape.get(), body.inertia_kg_m2);
  info.m_friction = std::sqrt(shape.friction);  // Bullet multiplies those of both bodies
  info.m_restitution = std::sqrt(config.restitution);
  info.m_linearSleepingThreshold = limits::sleep_speed_m_s;
  info.m_angularSleepingThreshold = limits::sleep_spin_rad_s;
  body.rigid = std::make_unique<btRigidBody>(info);
  body.rigid->setFlags(0);  // no gyroscopic torque: it costs a solve a body, and rubble does not show it
  add_hulls(shape, body);
  body.rigid->setUserPointer(body.hulls.get());
  body.rigid->setUserIndex(static_cast<int>(id));
  body.touches_by_surface = !shape.surface_m.empty();
  body.points_m = std::move(points_m);
  if (body.points_m.empty())
    body.points_m = shape.surface_m.empty()
                        ? surface_points(shape.hull_m, limits::sample_spacing_voxels * voxel_size_m)
                        : shape.surface_m;
  body.probe = terrain_collider->attach(body.points_m);
  return body;
}

Result<void> Bodies::State::restore(const BodyMotion& motion, std::shared_ptr<const BodyShape> shape,
                                    std::vector<glm::vec3> points_m) {
  TRY(check_shape(motion.id, *shape));
  TRY(check_motion(motion));
  Body& body = make(motion.id, std::move(shape), std::move(points_m));
  body.rigid->setCenterOfMassTransform(transform_of(motion));
  body.rigid->setLinearVelocity(to_bullet(motion.velocity_m_s));
  body.rigid->setAngularVelocity(to_bullet(motion.spin_rad_s));
  const float speed_max = rounding * 0.8F * limits::travel_max_voxels * voxel_size_m / step_s;
  if (body.rigid->getLinearVelocity().length() > speed_max ||
      body.rigid->getAngularVelocity().length() > rounding * body.spin_max_rad_s ||
      !scree::is_sound(pose_of(body))) {
    bodies.erase(motion.id);
    return refuse(motion.id, "it is faster than bodies are");
  }
  body.last = body.rigid->getWorldTransform();
  enter(body);
  if (motion.frozen) freeze(motion.id, body);
  if (motion.thawed) body.thawed = Bounds{to_bullet(motion.thawed->lo_m), to_bullet(motion.thawed->hi_m)};
  return {};
}

MotionValue Bodies::motions() const {
  MotionValue value;
  for (const auto& [id, body] : state_->bodies) {
    const btTransform& at = body.rigid->getWorldTransform();
    BodyMotion& motion = value.bodies.emplace_back();
    motion.id = id;
    motion.origin_m = from_bullet(at.getOrigin());
    for (int row = 0; row < 3; ++row)
      motion.basis[static_cast<size_t>(row)] = from_bullet(at.getBasis()[row]);
    motion.velocity_m_s = from_bullet(body.rigid->getLinearVelocity());
    motion.spin_rad_s = from_bullet(body.rigid->getAngularVelocity());
    motion.frozen = body.frozen.has_value();
    if (body.thawed) motion.thawed = BoundsM{from_bullet(body.thawed->lo), from_bullet(body.thawed->hi)};
  }
  for (const Bounds& bounds : state_->freed)
    value.freed.push_back({from_bullet(bounds.lo), from_bullet(bounds.hi)});
  value.changes = state_->changes;
  return value;
}

std::shared_ptr<const BodyShape> Bodies::shape(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.given;
}

Result<void> Bodies::restore(const std::vector<std::shared_ptr<const BodyShape>>& shapes,
                             const MotionValue& motions) {
  State& s = *state_;
  CHECK(s.bodies.empty());
  CHECK_EQ(shapes.size(), motions.bodies.size());
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (contains(motions.bodies[i].id)) return refuse(motions.bodies[i].id, "it comes twice");
    TRY(s.restore(motions.bodies[i], shapes[i]));
  }
  s.restore_common(motions);
  return {};
}

void Bodies::State::restore_common(const MotionValue& motions) {
  for (const BoundsM& bounds : motions.freed)
    freed.push_back({to_bullet(bounds.lo_m), to_bullet(bounds.hi_m)});
  changes = motions.changes;
}

void Bodies::renew() {
  const MotionValue now = motions();
  std::vector<std::pair<std::shared_ptr<const BodyShape>, std::vector<glm::vec3>>> known;
  for (auto& [id, body] : state_->bodies) known.emplace_back(body.given, std::move(body.points_m));
  while (size() > 0) remove(state_->bodies.begin()->first);
  state_ = std::make_unique<State>(state_->terrain_field, state_->config);
  for (size_t i = 0; i < known.size(); ++i) {
    const Result<void> restored =
        state_->restore(now.bodies[i], std::move(known[i].first), std::move(known[i].second));
    CHECK(restored.has_value());
  }
  state_->restore_common(now);
}

}  // namespace scree
