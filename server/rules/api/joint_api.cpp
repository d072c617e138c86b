// Joints, by handles.
#include "server/rules/api/asking.h"
#include "server/rules/api/joint_fields.h"
#include "server/rules/api/parts.h"

namespace scree {

namespace {

Result<void> add(RulesCall& call) {
  const ScriptValue table = call.argument(1, "joint");
  WantedJoint wanted;
  TRY(read_fields(&wanted, table, wanted_joint_fields, call.moment, {"by"}));
  const Joint joint = TRY(joint_of(wanted, world_of(call)));
  return ask_world(call, AddJointRequest{joint}, TRY(party_by(table)), 2);
}

Result<void> all(RulesCall& call) {
  const std::vector<KnownJoint> joints = world_of(call).joints();
  call.call.charge(work_of_body * static_cast<int64_t>(joints.size()));
  call.results().open_table();
  for (const KnownJoint& joint : joints) write_joint(call.results(), joint.id);
  call.results().close_table();
  return {};
}

Result<void> exists(RulesCall& call) {
  call.results().boolean(world_of(call).has_joint(TRY(read_joint(call.argument(1, "joint")))));
  return {};
}

/// Asks for something of a joint that is there; false where it is gone.
Result<void> act(RulesCall& call, JointId joint, Request request) {
  const bool there = world_of(call).has_joint(joint);
  if (there) TRY(ask_world(call, std::move(request)));
  call.results().boolean(there);
  return {};
}

Result<void> remove(RulesCall& call) {
  const JointId joint = TRY(read_joint(call.argument(1, "joint")));
  return act(call, joint, RemoveJointRequest{joint});
}

Result<void> motor(RulesCall& call) {
  const JointId joint = TRY(read_joint(call.argument(1, "joint")));
  const float speed = TRY(read_float(call.argument(2, "speed")));
  const float greatest = TRY(read_float(call.argument(3, "greatest")));
  return act(call, joint, SetMotorRequest{joint, {speed, greatest}});
}

constexpr ApiFunction joint_rows[] = {
    {"joints", "add", "what: new_joint, reply?: fun(reply: reply)", "",
     "Joins two bodies as they stand, or one to the rock at that place; the reply has the joint.",
     "bodies.add({ box = vec(0.5, 0.1, 0.5), at = vec(0, 4, 0) }, function(reply)\n"
     "  if not reply.body then return end\n"
     "  joints.add({ kind = \"rope\", a = reply.body, from = reply.body:place(), to = vec(0, -0.5, 0) },\n"
     "    function(made) if made.joint then made.joint:remove() end end)\n"
     "end)",
     add},
    {"joints", "all", "", "joint[]", "All joints, by number.", "log(#joints.all() .. \" joints\")", all},
    {"joint:", "exists", "", "boolean", "Whether it is still there: joints break, and bodies vanish.",
     "for _, joint in ipairs(joints.all()) do assert(joint:exists()) end", exists},
    {"joint:", "remove", "", "boolean", "Takes it away. False: it is gone.",
     "for _, joint in ipairs(joints.all()) do joint:remove() end", remove},
    {"joint:", "motor", "speed: number, greatest: number", "boolean",
     "Drives a hinge, rad/s and newton metres, or a slider, m/s and newtons. False: it is gone.",
     "for _, joint in ipairs(joints.all()) do joint:motor(2, 500) end", motor},
};

}  // namespace

std::span<const ApiFunction> joint_api() {
  return joint_rows;
}

}  // namespace scree
