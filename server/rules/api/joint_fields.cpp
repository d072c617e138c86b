#include "server/rules/api/joint_fields.h"

#include "server/rules/request_fields.h"

namespace scree {

namespace {

bool is_line(const void* of) {
  return joint_has<&JointRow::has_length, &WantedJoint::nature>(of);
}
bool is_at_one_place(const void* of) {
  return !is_line(of);
}
bool has_an_axis(const void* of) {
  return joint_has<&JointRow::has_axis, &WantedJoint::nature>(of);
}

Result<JointFrame> frame_of(PieceId body, const World& world) {
  if (body == 0) return JointFrame{};
  const auto facts = world.body(body);
  if (!facts) return fail("body " + std::to_string(body) + " is not there: it may have become terrain");
  return JointFrame{body, facts->pose.position_m, facts->pose.rotation};
}

constexpr std::array own_rows{
    needed(field<&WantedJoint::nature, &Joint::kind>("kind", "fixed, hinge, slider, ball, distance or rope")),
    body_field<&WantedJoint::a>("a", "one body; none: the terrain"),
    body_field<&WantedJoint::b>("b", "the other; none: the terrain"),
    if_applies(is_at_one_place,
               needed(field<&WantedJoint::place_m>("at", "where it holds both, in the world"))),
    if_applies(has_an_axis, field<&WantedJoint::axis>("axis", "of a hinge or a slider; upright as usual")),
    if_applies(is_line,
               needed(field<&WantedJoint::place_m>("from", "of a distance or a rope: where it holds a"))),
    if_applies(is_line, needed(field<&WantedJoint::other_place_m>("to", "where it holds b"))),
};

constexpr auto wanted_rows = joined(own_rows, joint_nature_fields<&WantedJoint::nature>());

}  // namespace

constexpr FieldTable wanted_joint_fields{
    "new_joint", "a joint", "Joins two bodies, or one to the terrain, as they stand.", wanted_rows};

Result<Joint> joint_of(const WantedJoint& wanted, const World& world) {
  const JointFrame a = TRY(frame_of(wanted.a, world));
  const JointFrame b = TRY(frame_of(wanted.b, world));
  const JointKind kind = wanted.nature.kind;
  const bool line = traits_of(kind).has_length;
  const Joint sides = line ? line_between(kind, a, wanted.place_m, b, wanted.other_place_m)
                           : joint_at(kind, a, b, wanted.place_m, wanted.axis);
  Joint joint = wanted.nature;
  joint.a = sides.a;
  joint.b = sides.b;
  if (line && joint.length_m == 0.0F) joint.length_m = sides.length_m;
  TRY(validate(joint));
  return joint;
}

}  // namespace scree
