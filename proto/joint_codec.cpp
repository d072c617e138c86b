#include "proto/joint_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

static_assert(wire::JointKind_ARRAYSIZE == kind_count<JointKind>);
static_assert(wire::JointEnd_ARRAYSIZE == kind_count<JointEnd>);

void write_side(wire::JointSide& to, const JointSide& from) {
  to.set_body(from.body);
  const JointSide usual;
  if (!same_bits(from.place_m, usual.place_m)) scree::write(*to.mutable_place(), from.place_m);
  if (same_bits(from.turn, usual.turn)) return;
  wire::Turn& turn = *to.mutable_turn();
  turn.set_x(from.turn.x);
  turn.set_y(from.turn.y);
  turn.set_z(from.turn.z);
  turn.set_w(from.turn.w);
}

JointSide read_side(const wire::JointSide& from, FieldChecker& check) {
  JointSide side;
  side.body = from.body();
  side.place_m = check.vec3(from.place(), "place of a joint");
  if (!from.has_turn()) return side;
  constexpr const char* what = "turn of a joint";
  const wire::Turn& turn = from.turn();
  side.turn = {check.finite(turn.w(), what), check.finite(turn.x(), what), check.finite(turn.y(), what),
               check.finite(turn.z(), what)};
  return side;
}

void write_joint(wire::Joint& to, const Joint& from) {
  to.set_kind(static_cast<wire::JointKind>(from.kind));
  write_side(*to.mutable_a(), from.a);
  write_side(*to.mutable_b(), from.b);
  if (from.limits) {
    to.mutable_limits()->set_low(from.limits->low);
    to.mutable_limits()->set_high(from.limits->high);
  }
  to.set_motor_speed(from.motor.speed);
  to.set_motor_greatest(from.motor.greatest);
  to.set_length(from.length_m);
  to.set_break_force_n(from.break_force_n);
  to.set_break_torque_nm(from.break_torque_nm);
  to.set_touches(from.touches);
}

Joint read_joint(const wire::Joint& from, FieldChecker& check) {
  Joint joint;
  joint.kind = check.asked_kind<JointKind>(from.kind(), "kind of a joint");
  joint.a = read_side(from.a(), check);
  joint.b = read_side(from.b(), check);
  if (from.has_limits())
    joint.limits = {check.finite(from.limits().low(), "lower limit of a joint"),
                    check.finite(from.limits().high(), "upper limit of a joint")};
  joint.motor = {check.finite(from.motor_speed(), "speed of a motor"),
                 check.not_negative(from.motor_greatest(), "force of a motor")};
  joint.length_m = check.not_negative(from.length(), "length of a joint");
  joint.break_force_n = check.not_negative(from.break_force_n(), "force that breaks a joint");
  joint.break_torque_nm = check.not_negative(from.break_torque_nm(), "torque that breaks a joint");
  joint.touches = from.touches();
  return joint;
}

template <typename List>
void check_count(const List& list, FieldChecker& check) {
  if (static_cast<size_t>(list.size()) > limits::joints_a_message)
    check.refuse(fmt::format("{} joints are over the limit of {}", list.size(), limits::joints_a_message));
}

}  // namespace

void write(wire::AddJoint& to, const AddJointMessage& from) {
  to.set_request(from.request);
  write_joint(*to.mutable_joint(), from.joint);
}

void write(wire::RemoveJoint& to, const RemoveJointMessage& from) {
  to.set_request(from.request);
  to.set_joint(from.joint);
}

void write(wire::SetMotor& to, const SetMotorMessage& from) {
  to.set_request(from.request);
  to.set_joint(from.joint);
  to.set_speed(from.motor.speed);
  to.set_greatest(from.motor.greatest);
}

void write(wire::JointHere& to, const KnownJoint& from) {
  to.set_id(from.id);
  write_joint(*to.mutable_joint(), from.joint);
}

void write(wire::Joints& to, const JointsMessage& from) {
  CHECK(from.here.size() <= limits::joints_a_message && from.gone.size() <= limits::joints_a_message);
  for (const KnownJoint& one : from.here) write(*to.add_here(), one);
  for (const EndedJoint& one : from.gone) {
    wire::JointGone& gone = *to.add_gone();
    gone.set_id(one.id);
    gone.set_why(static_cast<wire::JointEnd>(one.why));
  }
}

AddJointMessage read(const wire::AddJoint& from, FieldChecker& check) {
  return {{read_joint(from.joint(), check)}, from.request()};
}

RemoveJointMessage read(const wire::RemoveJoint& from, FieldChecker& /*check*/) {
  return {{from.joint()}, from.request()};
}

SetMotorMessage read(const wire::SetMotor& from, FieldChecker& check) {
  return {{from.joint(),
           {check.finite(from.speed(), "speed of a motor"),
            check.not_negative(from.greatest(), "force of a motor")}},
          from.request()};
}

KnownJoint read(const wire::JointHere& from, FieldChecker& check) {
  KnownJoint known{from.id(), read_joint(from.joint(), check)};
  if (const Result<void> valid = validate(known.joint); !valid) check.refuse(valid.error().message);
  return known;
}

JointsMessage read(const wire::Joints& from, FieldChecker& check) {
  JointsMessage joints;
  check_count(from.here(), check);
  check_count(from.gone(), check);
  for (const wire::JointHere& one : from.here()) {
    if (check.failed()) break;
    if (one.id() == 0 || (!joints.here.empty() && one.id() <= joints.here.back().id))
      check.refuse("the ids of joints do not ascend");
    joints.here.push_back(read(one, check));
  }
  for (const wire::JointGone& one : from.gone()) {
    if (check.failed()) break;
    if (one.id() == 0 || (!joints.gone.empty() && one.id() <= joints.gone.back().id))
      check.refuse("the ids of joints that are gone do not ascend");
    joints.gone.push_back({one.id(), FieldChecker::kind_or(one.why(), JointEnd::removed)});
  }
  if (!check.unknown().empty()) check.refuse(check.unknown() + " is unknown");
  return joints;
}

}  // namespace scree
