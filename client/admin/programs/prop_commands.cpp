#include "client/admin/programs/prop_commands.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crypto/sha256.h"
#include "shared/base/option_check.h"
#include "shared/base/regular_file.h"
#include "shared/prop/model_mesh.h"

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

/// The digest that 64 hexadecimal digits write; nothing where it is other text.
std::optional<Digest> digest_of(const std::string& text) {
  Digest digest{};
  if (text.size() != 2 * digest.size()) return std::nullopt;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) return std::nullopt;
    digest[i / 2] = static_cast<uint8_t>(digest[i / 2] * 16 + digit);
  }
  return digest;
}

/// The server says whether it has that model.
Result<Digest> model_named(const std::string& model) {
  if (const auto digest = digest_of(model)) return *digest;
  TRY(check_is_small_file(model, limits::model_bytes_max));
  const Result<std::string> read = read_bytes_of(model, limits::model_bytes_max);
  if (!read) return fail(model + ": " + read.error().message);
  return sha256({reinterpret_cast<const uint8_t*>(read->data()), read->size()});
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
  if (!words.model.empty()) add.prop.model = TRY(model_named(words.model));
  add.place_m = vector_of(words.at_m);
  add.velocity_m_s = vector_of(words.velocity_m_s);
  add.spin_rad_s = vector_of(words.spin_rad_s);
  return add;
}

Shape shape_of(const PropWords& words) {
  const glm::vec3 at_m = vector_of(words.at_m);
  if (words.half_m.empty()) return sphere(at_m, words.radius_m);
  return box(at_m, {words.half_m[0], words.half_m[1], words.half_m[2]});
}

CarveRequest piece_carve_of(const PropWords& words) {
  CarveRequest carve{.shape = shape_of(words), .seeds = words.seeds, .random_seed = 1};
  carve.impact_m = vector_of(words.at_m);
  carve.blast_speed_m_s = 0.0F;
  carve.piece = words.id;
  return carve;
}

CLI::Option* add_vector(CLI::App* command, const char* name, std::array<float, 3>& to, const char* what) {
  return command->add_option(name, to, what);
}

/// The subcommands about pieces.
void add_piece_commands(CLI::App& app, PropWords& words, PropCommands& commands) {
  commands.cut_out =
      app.add_subcommand("cut-out", "makes terrain a body that stays one until it is released");
  commands.carve_piece = app.add_subcommand("carve-piece", "carves a shape out of a piece where it is");
  commands.release = app.add_subcommand("release", "lets a body that was cut out become terrain again");
  for (CLI::App* command : {commands.carve_piece, commands.release})
    command->add_option("ID", words.id, "the id of the piece")->required();
  for (CLI::App* command : {commands.cut_out, commands.carve_piece}) {
    add_vector(command, "--at", words.at_m, "X Y Z of the shape's middle, metres")->required();
    command->add_option("--radius", words.radius_m, "the radius of a ball, metres")->capture_default_str();
    command->add_option("--half", words.half_m, "X Y Z: half the sides of a box instead, metres")
        ->expected(3);
  }
  commands.carve_piece->add_option("--seeds", words.seeds, "into how many pieces the shape breaks")
      ->capture_default_str();
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
  commands.add->add_option(
      "--model", words.model,
      "the model that shows it, which the server must have (--models): its file (.glb), or "
      "the SHA-256 of that");
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
  add_piece_commands(app, words, commands);
  return commands;
}

Result<Request> request_of(const PropCommands& commands, const PropWords& words, const AdminServer& server) {
  if (commands.add->parsed()) return addition_of(words, server);
  if (commands.push->parsed())
    return PushRequest{words.id, vector_of(words.impulse_n_s), vector_of(words.at_m)};
  if (commands.remove->parsed()) return RemovePropRequest{words.id};
  if (commands.blast->parsed()) return BlastRequest{vector_of(words.at_m), words.energy_j, 1};
  if (commands.cut_out->parsed()) return CutOutRequest{shape_of(words)};
  if (commands.carve_piece->parsed()) return piece_carve_of(words);
  if (commands.release->parsed()) return ReleaseRequest{words.id};
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
  if (reply.prop && reply.pieces > 0)
    return fmt::format("piece {} is kept, the first of {}\n", *reply.prop, reply.pieces);
  if (reply.prop) return fmt::format("prop {} is added\n", *reply.prop);
  return reply.pieces > 0 ? fmt::format("done, {} pieces\n", reply.pieces) : "done\n";
}

}  // namespace scree
