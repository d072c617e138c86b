// Requests about joints.
#include "server/rules/request_fields.h"

namespace scree {

namespace {

constexpr std::array side_rows{
    body_field<&JointSide::body>("body", "that it holds; none: the terrain"),
    field<&JointSide::place_m>("at", "where, in the body's own axes; of the terrain in the world's"),
    field<&JointSide::turn>("turn", "of the joint's axes in the body's; a hinge turns about x"),
};

Result<void> check_joint(void* of, const GivenFields&, const RulesMoment&) {
  return validate(static_cast<const AddJointRequest*>(of)->joint);
}

}  // namespace

constexpr FieldTable joint_side_fields{"joint_side", "a side of a joint", "What a joint holds.", side_rows};

namespace {

constexpr std::array add_joint_rows = joined(
    std::array{
        needed(field<&AddJointRequest::joint, &Joint::kind>("joint_kind",
                                                            "fixed, hinge, slider, ball, distance or rope")),
        needed(field_by<TableCodec<joint_side_fields>, &AddJointRequest::joint, &Joint::a>("a", "one side")),
        needed(field_by<TableCodec<joint_side_fields>, &AddJointRequest::joint, &Joint::b>("b", "the other")),
    },
    joint_nature_fields<&AddJointRequest::joint>());

constexpr std::array remove_joint_rows{
    needed(field_by<JointCodec, &RemoveJointRequest::joint>("joint", "that is taken away"))};

constexpr std::array set_motor_rows{
    needed(field_by<JointCodec, &SetMotorRequest::joint>("joint", "that has an axis")),
    needed(field<&SetMotorRequest::motor, &JointMotor::speed>("speed", "rad/s of a hinge, m/s of a slider")),
    needed(field<&SetMotorRequest::motor, &JointMotor::greatest>("greatest", "newton metres, or newtons")),
};

}  // namespace

constexpr FieldTable add_joint_fields{"add_joint", "an add_joint",
                                      "Joins two bodies, or one to the terrain, by places in their own axes.",
                                      add_joint_rows, check_joint};
constexpr FieldTable remove_joint_fields{"remove_joint", "a remove_joint", "Takes a joint away.",
                                         remove_joint_rows};
constexpr FieldTable set_motor_fields{"set_motor", "a set_motor", "Changes the motor of a joint.",
                                      set_motor_rows};

}  // namespace scree
