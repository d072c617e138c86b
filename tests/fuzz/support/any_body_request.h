// Requests about props, joints and pieces derived from a fuzzer's bytes: mostly of bodies that are there, and
// of the sizes that games ask for, now and then of any numbers. Metres, kilograms.
#pragma once

#include <map>
#include <vector>

#include "shared/field/piece.h"
#include "shared/operation/blast.h"
#include "tests/fuzz/support/any_request.h"

namespace scree {

/// What a request may be of.
struct KnownBodies {
  std::map<PieceId, Pose> bodies;
  std::vector<JointId> joints;
};

/// One that is there, or any id of a byte.
inline PieceId any_body(FuzzInput& input, const KnownBodies& known) {
  if (known.bodies.empty() || input.below(16) == 15) return input.byte();
  auto body = known.bodies.begin();
  std::advance(body, input.byte() % known.bodies.size());
  return body->first;
}
inline JointId any_joint_id(FuzzInput& input, const KnownBodies& known) {
  if (known.joints.empty() || input.below(16) == 15) return input.byte();
  return known.joints[input.byte() % known.joints.size()];
}

/// None, a quarter about an axis, or any numbers.
inline glm::quat any_turn(FuzzInput& input) {
  constexpr float half = 0.70710678F;
  switch (input.below(8)) {
    case 0:
      return {half, half, 0.0F, 0.0F};
    case 1:
      return {half, 0.0F, -half, 0.0F};
    case 2:
      return {half, 0.0F, -0.0F, half};
    case 3:
      return {input.coordinate(1.0F), input.coordinate(1.0F), input.coordinate(1.0F), input.coordinate(1.0F)};
    default:
      return {1.0F, -0.0F, 0.0F, 0.0F};
  }
}

inline PropPart any_part(FuzzInput& input) {
  PropPart part;
  part.kind = any_number_as<PropPartKind>(input);
  if (input.below(4) == 3) part.place_m = input.place(2.0F);
  part.turn = any_turn(input);
  part.half_m = {0.2F + std::abs(input.coordinate(1.5F)), 0.2F + std::abs(input.coordinate(1.5F)),
                 0.2F + std::abs(input.coordinate(1.5F))};
  if (part.kind == PropPartKind::hull)
    for (uint32_t count = 4 + input.below(6); count > 0; --count) part.corners_m.push_back(input.place(1.5F));
  return part;
}

inline AddPropRequest any_prop(FuzzInput& input) {
  AddPropRequest add;
  Prop& prop = add.prop;
  for (uint32_t count = 1 + input.below(3); count > 0; --count) prop.parts.push_back(any_part(input));
  prop.motion = any_number_as<PropMotion>(input);
  if (input.flag()) prop.mass_kg = std::abs(input.coordinate(1e4F));
  if (input.flag()) prop.restitution = std::abs(input.coordinate(1.0F));
  if (input.below(4) == 3) prop.gravity = input.coordinate(4.0F);
  if (input.below(4) == 3) prop.drag = std::abs(input.coordinate(1.0F));
  if (input.below(8) == 7) prop.groups = input.number<uint32_t>();
  if (input.below(8) == 7) prop.meets = input.number<uint32_t>();
  prop.tag = input.byte();
  add.place_m = any_place(input);
  add.turn = any_turn(input);
  if (input.flag()) add.velocity_m_s = input.place(input.flag() ? 20.0F : 600.0F);
  if (input.below(4) == 3) add.spin_rad_s = input.place(20.0F);
  return add;
}

inline JointFrame frame_in(const KnownBodies& known, PieceId id) {
  const auto found = known.bodies.find(id);
  return found == known.bodies.end() ? JointFrame{id}
                                     : JointFrame{id, found->second.position_m, found->second.rotation};
}

/// Between bodies as they stand, or a body and the terrain; or of any members.
inline AddJointRequest any_joint(FuzzInput& input, const KnownBodies& known) {
  const JointKind kind = any_kind<JointKind>(input);
  const JointFrame a = frame_in(known, input.below(4) == 3 ? 0 : any_body(input, known));
  const JointFrame b = frame_in(known, any_body(input, known));
  const glm::vec3 at_m = input.flag() ? 0.5F * (a.origin_m + b.origin_m) : any_place(input);
  const glm::vec3 axis{0.25F, input.between(-1.0F, 1.0F), input.between(-1.0F, 1.0F)};
  AddJointRequest add;
  Joint& joint = add.joint;
  joint = traits_of(kind).has_length ? line_between(kind, a, a.origin_m, b, input.flag() ? b.origin_m : at_m)
                                     : joint_at(kind, a, b, at_m, axis);
  if (input.below(4) == 3)
    joint.limits = JointLimits{-std::abs(input.coordinate(2.0F)), input.coordinate(2.0F)};
  if (input.below(4) == 3) joint.motor = {input.coordinate(20.0F), std::abs(input.coordinate(1e6F))};
  if (input.below(4) == 3) joint.break_force_n = std::abs(input.coordinate(1e5F));
  if (input.below(8) == 7) joint.break_torque_nm = std::abs(input.coordinate(1e5F));
  if (input.below(8) == 7) joint.length_m = std::abs(input.coordinate(20.0F));
  if (input.below(16) == 15) joint.a.place_m = input.place(70.0F);
  if (input.below(16) == 15) joint.b.turn = any_turn(input);
  if (input.below(16) == 15) joint.kind = any_number_as<JointKind>(input);
  joint.touches = input.flag();
  return add;
}

inline MovePropRequest any_move(FuzzInput& input, const KnownBodies& known) {
  MovePropRequest move{any_body(input, known)};
  if (input.flag()) move.place_m = any_place(input);
  if (input.below(4) == 3) move.turn = any_turn(input);
  if (input.flag()) move.velocity_m_s = input.place(input.flag() ? 10.0F : 600.0F);
  if (input.below(4) == 3) move.spin_rad_s = input.place(20.0F);
  return move;
}

inline Request any_body_request(FuzzInput& input, const KnownBodies& known) {
  switch (input.below(16)) {
    case 0:
    case 1:
    case 2:
      return any_prop(input);
    case 3:
    case 4:
    case 5:
      return any_joint(input, known);
    case 6:
      return any_move(input, known);
    case 7: {
      const PieceId body = any_body(input, known);
      return PushRequest{body, input.place(input.flag() ? 1e4F : 1e9F),
                         frame_in(known, body).origin_m + input.place(1.0F)};
    }
    case 8:
      return BlastRequest{any_place(input), 4e3F + std::abs(input.coordinate(5e7F)), input.byte()};
    case 9:
      return CutOutRequest{any_shape(input)};
    case 10: {
      CarveRequest carve = any_carve(input);
      carve.piece = any_body(input, known);
      const bool there = input.flag();
      if (there)
        carve.shape = sphere(frame_in(known, carve.piece).origin_m, std::abs(input.coordinate(3.0F)));
      return carve;
    }
    case 11:
      return ReleaseRequest{any_body(input, known)};
    case 12: {
      const PieceId piece = any_body(input, known);
      return BreakRequest{piece, frame_in(known, piece).origin_m, input.below(12), input.byte()};
    }
    case 13:
      return SetMotorRequest{any_joint_id(input, known), {input.coordinate(20.0F), input.coordinate(1e6F)}};
    case 14:
      return input.flag() ? Request(RemoveJointRequest{any_joint_id(input, known)})
                          : Request(RemovePropRequest{any_body(input, known)});
    default:
      if (input.below(3) == 2) return any_store_request(input, any_body(input, known));
      return input.flag() ? Request(any_carve(input))
                          : Request(FillRequest{any_shape(input), any_fill(input)});
  }
}

}  // namespace scree
