// The fields of each kind of request that scripts can write.
#pragma once

#include <array>
#include <string_view>

#include "server/rules/field_of.h"
#include "shared/field/shape.h"
#include "shared/operation/request.h"
#include "shared/prop/joint.h"
#include "shared/prop/prop.h"

namespace scree {

extern const FieldTable carve_fields, fill_fields, paint_fields, blast_fields, dig_fields, place_fields,
    transfer_fields, cut_out_fields;  // request_edits.cpp
extern const FieldTable add_prop_fields, prop_part_fields, remove_prop_fields, move_prop_fields, push_fields,
    break_fields, release_fields;  // request_bodies.cpp
extern const FieldTable add_joint_fields, joint_side_fields, remove_joint_fields,
    set_motor_fields;                                                           // request_joints.cpp
extern const FieldTable set_region_fields, remove_region_fields, stand_fields;  // request_regions.cpp

inline constexpr std::array joint_limits_rows{
    field<&JointLimits::low>("low", "radians of a hinge, metres of a slider"),
    field<&JointLimits::high>("high", "likewise"),
};
inline constexpr FieldTable joint_limits_fields{"joint_limits", "limits", "How far a joint turns, or slides.",
                                                joint_limits_rows};

inline constexpr std::array joint_motor_rows{
    field<&JointMotor::speed>("speed", "rad/s of a hinge, m/s of a slider"),
    field<&JointMotor::greatest>("greatest", "newton metres, or newtons; 0: there is no motor"),
};
inline constexpr FieldTable joint_motor_fields{"joint_motor", "a motor", "What drives a joint.",
                                               joint_motor_rows};

template <ShapeKind kind, bool is, auto... Path>
bool shape_is(const void* of) {
  return (member_of<Path...>(of).kind == kind) == is;
}
template <bool JointRow::*has, auto... Path>
bool joint_has(const void* of) {
  const JointKind kind = member_of<Path...>(of).kind;
  return is_known(kind) && traits_of(kind).*has;
}

/// The fields of the shape that a path leads to.
template <auto... Path>
constexpr std::array<FieldRow, 7> shape_fields() {
  constexpr auto at_centre = shape_is<ShapeKind::capsule, false, Path...>;
  constexpr auto is_capsule = shape_is<ShapeKind::capsule, true, Path...>;
  constexpr auto is_round = shape_is<ShapeKind::box, false, Path...>;
  constexpr auto is_box = shape_is<ShapeKind::box, true, Path...>;
  return {
      field<Path..., &Shape::kind>("shape", "sphere (as usual), box, capsule or crater"),
      if_applies(at_centre, needed(field<Path..., &Shape::a>("at", "its centre; not of a capsule"))),
      if_applies(is_box, needed(field<Path..., &Shape::b>("half", "half the sides of a box, x, y and z"))),
      if_applies(is_capsule, needed(field<Path..., &Shape::a>("from", "one end of a capsule's axis"))),
      if_applies(is_capsule, needed(field<Path..., &Shape::b>("to", "the other end"))),
      if_applies(is_round,
                 needed(field<Path..., &Shape::radius_m>("radius", "metres; of all shapes but a box"))),
      if_applies(is_box, field<Path..., &Shape::radius_m>("rounding", "radius of a box's edges, metres")),
  };
}

/// What a joint has by its kind, of the one that a path leads to.
template <auto... Path>
constexpr std::array<FieldRow, 6> joint_nature_fields() {
  constexpr auto has_axis = joint_has<&JointRow::has_axis, Path...>;
  constexpr auto has_length = joint_has<&JointRow::has_length, Path...>;
  constexpr auto has_torque = joint_has<&JointRow::has_torque, Path...>;
  return {
      if_applies(has_axis, field_by<TableCodec<joint_limits_fields>, Path..., &Joint::limits>(
                               "limits", "of a hinge or a slider: how far it goes")),
      if_applies(has_axis, field_by<TableCodec<joint_motor_fields>, Path..., &Joint::motor>(
                               "motor", "of a hinge or a slider: what drives it")),
      if_applies(has_length,
                 field<Path..., &Joint::length_m>("length", "of a distance, and of a rope at most; metres")),
      field<Path..., &Joint::break_force_n>("break_force", "at which it breaks, newtons; 0: at none"),
      if_applies(has_torque,
                 field<Path..., &Joint::break_torque_nm>("break_torque", "likewise, newton metres")),
      field<Path..., &Joint::touches>("touches", "whether the two bodies may touch each other"),
  };
}

}  // namespace scree
