#include "shared/prop/joint.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/plain_number.h"
#include "shared/prop/limits.h"

namespace scree {

namespace {

Result<void> check_within(float value, float least, float most, const char* what, const char* unit) {
  if (value >= least && value <= most) return {};
  return fail("the joint's " + std::string(what) + " is " + with_unit(value, unit) + ", and must lie " +
              range_text(least, most, unit));
}

bool is_in_world(glm::vec3 place_m) {
  return std::abs(place_m.x) <= limits::world_half_width_m &&
         std::abs(place_m.y) <= limits::world_half_height_m &&
         std::abs(place_m.z) <= limits::world_half_width_m;
}

Result<void> check_side(const JointSide& side) {
  const glm::vec3 p = side.place_m;
  if (side.holds_terrain() && !is_in_world(p))
    return fail("a joint's place in the terrain lies outside the world");
  const float far_m = limits::joint_place_max_m;
  if (!side.holds_terrain() && !(glm::dot(p, p) <= far_m * far_m))
    return fail("a joint's place lies farther from its body's origin than " + metres(far_m));
  if (!(std::abs(glm::dot(side.turn, side.turn) - 1.0F) < 1e-3F))
    return fail("a joint's rotation is no unit quaternion");
  return {};
}

Result<void> check_limits(const JointLimits& bounds, JointKind kind) {
  const bool turns = kind == JointKind::hinge;
  const float most = turns ? limits::joint_angle_max_rad : limits::joint_way_max_m;
  const char* const unit = turns ? "rad" : "m";
  TRY(check_within(bounds.low, -most, most, "lower limit", unit));
  TRY(check_within(bounds.high, -most, most, "upper limit", unit));
  if (bounds.low <= bounds.high) return {};
  return fail("the joint's lower limit is above its upper one");
}

/// The turn that takes x to that direction.
glm::quat turn_to(glm::vec3 axis) {
  const float length2 = glm::dot(axis, axis);
  CHECK(length2 > 0.0F);
  axis /= std::sqrt(length2);
  if (axis.x < -0.9999F) return {0.0F, 0.0F, 0.0F, 1.0F};  // half a turn about z
  const glm::quat turn(1.0F + axis.x, 0.0F, -axis.z, axis.y);
  return turn / std::sqrt(glm::dot(turn, turn));
}

JointSide side_at(const JointFrame& frame, glm::vec3 place_m, const glm::quat& turn) {
  const glm::quat back = glm::conjugate(frame.turn);
  const glm::quat side = back * turn;
  return {frame.body, back * (place_m - frame.origin_m), side / std::sqrt(glm::dot(side, side))};
}

}  // namespace

Result<void> validate(const JointMotor& motor, JointKind kind) {
  TRY(validate_kind(kind, "kind of the joint"));
  if (!traits_of(kind).has_axis) {
    if (motor == JointMotor{}) return {};
    return fail("a joint of kind " + std::string(name_of(kind)) + " has no motor");
  }
  const bool turns = kind == JointKind::hinge;
  const float most = turns ? limits::joint_spin_max_rad_s : limits::joint_speed_max_m_s;
  TRY(check_within(motor.speed, -most, most, "motor's speed", turns ? "rad/s" : "m/s"));
  return check_within(motor.greatest, 0.0F, limits::joint_force_max,
                      turns ? "motor's torque" : "motor's force", turns ? "N m" : "N");
}

Result<void> validate(const Joint& joint) {
  TRY(validate_kind(joint.kind, "kind of the joint"));
  const JointRow& row = traits_of(joint.kind);
  const std::string name(row.name);
  if (joint.a.body == joint.b.body) return fail("a joint holds a body to itself, or the terrain alone");
  TRY(check_side(joint.a));
  TRY(check_side(joint.b));
  TRY(validate(joint.motor, joint.kind));
  if (joint.limits && !row.has_axis) return fail("a joint of kind " + name + " has no limits");
  if (joint.limits) TRY(check_limits(*joint.limits, joint.kind));
  if (row.has_length)
    TRY(check_within(joint.length_m, limits::joint_length_min_m, limits::joint_length_max_m, "length", "m"));
  if (!row.has_length && joint.length_m != 0.0F) return fail("a joint of kind " + name + " has no length");
  TRY(check_within(joint.break_force_n, 0.0F, limits::joint_force_max, "force at which it breaks", "N"));
  TRY(check_within(joint.break_torque_nm, 0.0F, limits::joint_force_max, "torque at which it breaks", "N m"));
  if (!row.has_torque && joint.break_torque_nm != 0.0F)
    return fail("a joint of kind " + name + " bears no torque, so none breaks it");
  return {};
}

Joint joint_at(JointKind kind, const JointFrame& a, const JointFrame& b, glm::vec3 place_m, glm::vec3 axis) {
  const glm::quat turn = turn_to(axis);
  Joint joint;
  joint.kind = kind;
  joint.a = side_at(a, place_m, turn);
  joint.b = side_at(b, place_m, turn);
  return joint;
}

Joint line_between(JointKind kind, const JointFrame& a, glm::vec3 place_a_m, const JointFrame& b,
                   glm::vec3 place_b_m) {
  constexpr glm::quat unturned(1.0F, 0.0F, 0.0F, 0.0F);
  const glm::vec3 off_m = place_b_m - place_a_m;
  Joint joint;
  joint.kind = kind;
  joint.a = side_at(a, place_a_m, unturned);
  joint.b = side_at(b, place_b_m, unturned);
  joint.length_m = std::sqrt(glm::dot(off_m, off_m));
  return joint;
}

}  // namespace scree
