#include "client/admin/programs/prop_commands.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shared/base/option_check.h"

namespace scree {

namespace {

glm::vec3 vector_of(const std::array<float, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// The size of a part as people say it: a box by its sides, others by diameter and length.
Result<PropPart> part_of(const PropWords& words) {
  const auto kind = kind_named<PropPartKind>(words.shape);
  PropPart part;
  const auto of = [&](size_t numbers, const char* which) -> Result<void> {
    if (words.size_m.size() == numbers) return {};
    return fail(fmt::format("a {} has {}", words.shape, which));
  };
  if (kind == PropPartKind::box) {
    TRY(of(3, "three sides: X Y Z"));
    part.half_m = 0.5F * glm::vec3(words.size_m[0], words.size_m[1], words.size_m[2]);
  } else if (kind == PropPartKind::sphere) {
    TRY(of(1, "a diameter"));
    part.half_m = glm::vec3(0.5F * words.size_m[0]);
  } else if (kind == PropPartKind::cylinder || kind == PropPartKind::capsule) {
    TRY(of(2, "a diameter and a length"));
    const float ends = kind == PropPartKind::capsule ? words.size_m[0] : 0.0F;
    part.half_m = {0.5F * words.size_m[0], 0.5F * (words.size_m[1] - ends), 0.0F};
  } else {
    return fail("a prop is a box, a sphere, a capsule or a cylinder; hulls and several parts take a program");
  }
  part.kind = *kind;
  return part;
}

Result<Request> addition_of(const PropWords& words, const AdminServer& server) {
  AddPropRequest add;
  add.prop.parts = {TRY(part_of(words))};
  add.prop.mass_kg = words.mass_kg;
  add.prop.tag = words.tag;
  add.prop.motion = kind_named<PropMotion>(words.motion).value_or(PropMotion::dynamic);
  if (!words.material.empty()) {
    const auto palette = TRY(read_materials(server));
    add.prop.material = TRY(material_named(palette, words.material));
  }
  add.place_m = vector_of(words.at_m);
  add.velocity_m_s = vector_of(words.velocity_m_s);
  add.spin_rad_s = vector_of(words.spin_rad_s);
  return add;
}

CLI::Option* add_vector(CLI::App* command, const char* name, std::array<float, 3>& to, const char* what) {
  return command->add_option(name, to, what);
}

}  // namespace

PropCommands add_prop_commands(CLI::App& app, PropWords& words) {
  PropCommands commands;
  commands.add = app.add_subcommand("add-prop", "adds a body of a game, and prints its id");
  commands.add
      ->add_option("SHAPE", words.shape, "box, sphere, cylinder or capsule; the last two stand upright")
      ->required();
  commands.add
      ->add_option("SIZE", words.size_m,
                   "metres: a box has three sides, a sphere its diameter, the others diameter and length")
      ->required()
      ->expected(1, 3);
  add_vector(commands.add, "--at", words.at_m, "X Y Z of its middle, metres")->required();
  commands.add->add_option("--mass", words.mass_kg, "kilograms; 0: by the density of its material")
      ->capture_default_str();
  commands.add->add_option("--material", words.material, "the material by which it is drawn and weighs");
  commands.add->add_option("--motion", words.motion, "dynamic, kinematic or fixed")
      ->check(CLI::IsMember(std::vector<std::string>{"dynamic", "kinematic", "fixed"}))
      ->capture_default_str();
  commands.add->add_option("--tag", words.tag, "a number of your own");
  commands.move = app.add_subcommand("move-prop", "puts a prop elsewhere, or changes its speed");
  commands.push = app.add_subcommand("push", "gives a prop or a piece an impulse");
  commands.remove = app.add_subcommand("remove-prop", "takes a prop out of the world");
  for (CLI::App* command : {commands.move, commands.push, commands.remove})
    command->add_option("ID", words.id, "the id that add-prop printed")->required();
  add_vector(commands.move, "--at", words.at_m, "X Y Z, metres");
  for (CLI::App* command : {commands.add, commands.move}) {
    add_vector(command, "--velocity", words.velocity_m_s, "metres a second along X Y Z");
    add_vector(command, "--spin", words.spin_rad_s, "radians a second about X Y Z");
  }
  add_vector(commands.push, "--impulse", words.impulse_n_s, "newton seconds along X Y Z")->required();
  add_vector(commands.push, "--at", words.at_m, "X Y Z of a place of the body, metres")->required();
  commands.blast = app.add_subcommand("blast", "sets energy free at a place: rock breaks, bodies are thrown");
  add_vector(commands.blast, "--at", words.at_m, "X Y Z, metres")->required();
  commands.blast->add_option("--energy", words.energy_j, "joules; a kilogram of TNT has 4.2e6")
      ->capture_default_str();
  return commands;
}

Result<Request> request_of(const PropCommands& commands, const PropWords& words, const AdminServer& server) {
  if (commands.add->parsed()) return addition_of(words, server);
  if (commands.push->parsed())
    return PushRequest{words.id, vector_of(words.impulse_n_s), vector_of(words.at_m)};
  if (commands.remove->parsed()) return RemovePropRequest{words.id};
  if (commands.blast->parsed()) return BlastRequest{vector_of(words.at_m), words.energy_j, 1};
  MovePropRequest move{words.id};
  if (commands.move->count("--at") > 0) move.place_m = vector_of(words.at_m);
  if (commands.move->count("--velocity") > 0) move.velocity_m_s = vector_of(words.velocity_m_s);
  if (commands.move->count("--spin") > 0) move.spin_rad_s = vector_of(words.spin_rad_s);
  return move;
}

std::string answer_text(const ReplyMessage& reply, bool as_json) {
  if (as_json) {
    nlohmann::ordered_json json{{"tick", reply.tick}, {"pieces", reply.pieces}};
    if (reply.prop) json["prop"] = *reply.prop;
    return json.dump(2) + "\n";
  }
  if (reply.prop) return fmt::format("prop {} is added\n", *reply.prop);
  return reply.pieces > 0 ? fmt::format("done, {} pieces\n", reply.pieces) : "done\n";
}

}  // namespace scree
