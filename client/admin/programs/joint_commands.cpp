// add-joint, set-motor and remove-joint.
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "client/admin/programs/world_commands.h"

namespace scree {

namespace {

/// What these were told. Metres, radians, newtons.
struct JointWords {
  std::string kind;
  PieceId a = 0, b = 0;
  Place at_m{}, to_m{}, axis{1.0F, 0.0F, 0.0F};
  std::array<float, 2> limits{}, motor{};
  float length_m = 0.0F, break_force_n = 0.0F, break_torque_nm = 0.0F;
  bool touches = false;
  JointId joint = 0;
};

Result<JointFrame> frame_of(PieceId body, const AdminListMessage& list) {
  if (body == 0) return JointFrame{};
  const auto row = std::ranges::find(list.bodies, body, &BodyRow::id);
  if (row == list.bodies.end()) return fail(fmt::format("there is no body {}", body));
  const Pose pose = dequantise(row->pose);
  return JointFrame{body, pose.position_m, pose.rotation};
}

using Checked = tl::expected<void, Failed>;

/// Refuses options that the kind of joint has no use for, and a line without a length.
Checked check_words(JointKind kind, const CLI::App& command) {
  const auto& traits = traits_of(kind);
  const auto takes = [&](const char* option, bool has) -> Checked {
    if (has || command.count(option) == 0) return {};
    return misused({fmt::format("a {} takes no {}", name_of(kind), option)});
  };
  TRY(takes("--to", traits.has_length));
  TRY(takes("--length", traits.has_length));
  TRY(takes("--axis", traits.has_axis));
  TRY(takes("--limits", traits.has_axis));
  TRY(takes("--motor", traits.has_axis));
  if (traits.has_length && command.count("--to") == 0 && command.count("--length") == 0)
    return misused({fmt::format("a {} takes --to, where it holds b, or --length", name_of(kind))});
  return {};
}

/// Asks the server where the bodies are.
Made addition_of(const JointWords& words, const CLI::App& command, const AdminServer& server) {
  const JointKind kind = *kind_named<JointKind>(words.kind);
  const glm::vec3 at_m = vector_of(words.at_m), axis = vector_of(words.axis);
  const glm::vec3 to_m = command.count("--to") > 0 ? vector_of(words.to_m) : at_m;
  if (axis == glm::vec3(0.0F)) return misused({"the axis has no direction"});
  TRY(check_words(kind, command));
  if (words.a == words.b) return misused({"--a and --b are the same"});
  ListBodiesRequest wanted;
  for (const PieceId id : {words.a, words.b})
    if (id != 0) wanted.ids.push_back(id);
  const auto list = TRY(list_bodies(server, wanted));
  const auto a = TRY(frame_of(words.a, list)), b = TRY(frame_of(words.b, list));
  AddJointRequest add;
  add.joint =
      traits_of(kind).has_length ? line_between(kind, a, at_m, b, to_m) : joint_at(kind, a, b, at_m, axis);
  if (command.count("--length") > 0) add.joint.length_m = words.length_m;
  if (command.count("--limits") > 0) add.joint.limits = JointLimits{words.limits[0], words.limits[1]};
  if (command.count("--motor") > 0) add.joint.motor = {words.motor[0], words.motor[1]};
  add.joint.break_force_n = words.break_force_n;
  add.joint.break_torque_nm = words.break_torque_nm;
  add.joint.touches = words.touches;
  if (const Result<void> valid = validate(add.joint); !valid) return misused(valid.error());
  return add;
}

std::vector<std::string> kinds_of_joints() {
  std::vector<std::string> names;
  for (const JointKind kind : all_kinds<JointKind>) names.emplace_back(name_of(kind));
  return names;
}

void add_words_of_joint(CLI::App* add, JointWords& words) {
  add->add_option("KIND", words.kind, "fixed, hinge, slider, ball, distance or rope")
      ->required()
      ->check(CLI::IsMember(kinds_of_joints()));
  add_id(add, "--a", words.a, "the one side: the id of a body, or terrain", true)->required();
  add_id(add, "--b", words.b, "the other side", true)->required();
  add_place(add, "--at", words.at_m, "X Y Z where it holds them; of a rope and a distance: where it holds a")
      ->required();
  add_place(add, "--to", words.to_m, "X Y Z where a rope or a distance holds b");
  add_place(add, "--axis", words.axis, "X Y Z: the direction of a hinge's or a slider's axis")
      ->capture_default_str();
  add->add_option("--limits", words.limits,
                  "LOW HIGH of a hinge, radians, or of a slider, metres: how far b turns about the "
                  "axis (by the right hand), or goes along it, as a sees it; 0 is how they are joined")
      ->delimiter(',');
  add->add_option(
         "--motor", words.motor,
         "SPEED GREATEST: rad/s and newton metres of a hinge, m/s and newtons of a slider; the speed is "
         "that of b as a sees it")
      ->delimiter(',');
  add->add_option("--length", words.length_m, "metres; else as far as --at and --to are apart");
  add->add_option("--break-force", words.break_force_n, "newtons at which it breaks; 0: none")
      ->capture_default_str();
  add->add_option("--break-torque", words.break_torque_nm, "newton metres at which it breaks; 0: none")
      ->capture_default_str();
  add->add_flag("--touches", words.touches, "its two bodies may touch each other");
}

}  // namespace

void add_joint_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<JointWords>();
  CLI::App* const add = app.add_subcommand("add-joint", "joins two bodies, or one to the terrain");
  CLI::App* const motor = app.add_subcommand("set-motor", "changes the motor of a hinge or a slider");
  CLI::App* const remove = app.add_subcommand("remove-joint", "ends a joint");
  add_words_of_joint(add, *words);
  for (CLI::App* command : {motor, remove})
    add_id(command, "JOINT", words->joint, "the id that add-joint printed")->required();
  motor->add_option("SPEED", words->motor[0], "rad/s of a hinge, m/s of a slider: of b as a sees it")
      ->required();
  motor->add_option("GREATEST", words->motor[1], "newton metres or newtons at most; 0: no motor")
      ->required()
      ->check(CLI::NonNegativeNumber);
  table.push_back({add, [words, add](const AdminServer& server, bool as_json) {
                     return run_request(server, addition_of(*words, *add, server), as_json);
                   }});
  table.push_back({motor, [words](const AdminServer& server, bool as_json) {
                     const SetMotorRequest set{words->joint, {words->motor[0], words->motor[1]}};
                     return run_request(server, Request(set), as_json);
                   }});
  table.push_back({remove, [words](const AdminServer& server, bool as_json) {
                     return run_request(server, Request(RemoveJointRequest{words->joint}), as_json);
                   }});
}

}  // namespace scree
