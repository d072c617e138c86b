// add-prop, move-prop, remove-prop, push, break, blast, cut-out, carve-piece and release.
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "crypto/sha256.h"
#include "shared/base/regular_file.h"
#include "shared/prop/model_mesh.h"

namespace scree {

namespace {

/// What these were told. Metres, kilograms, seconds.
struct PropWords {
  std::string shape;
  std::vector<float> size_m;
  Place at_m{}, velocity_m_s{}, spin_rad_s{}, impulse_n_s{}, turn_degrees{};
  float friction = Prop().friction, restitution = Prop().restitution, gravity = Prop().gravity;
  float mass_kg = 0.0F, energy_j = 4.2e6F;
  std::string motion = "dynamic", material, model;
  uint64_t tag = 0;
  PieceId id = 0;
  std::vector<float> half_m;  ///< of a box; else a ball of this radius
  float radius_m = 1.0F;
  uint32_t seeds = 8;
};

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

/// About X first, then about Y, then about Z: axes of the world.
glm::quat turn_of(const Place& degrees) {
  const glm::vec3 angle = glm::radians(vector_of(degrees));
  return glm::angleAxis(angle.z, glm::vec3(0.0F, 0.0F, 1.0F)) *
         glm::angleAxis(angle.y, glm::vec3(0.0F, 1.0F, 0.0F)) *
         glm::angleAxis(angle.x, glm::vec3(1.0F, 0.0F, 0.0F));
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

/// Asks the server for its materials where one was named.
Made addition_of(const PropWords& words, const AdminServer& server) {
  AddPropRequest add;
  const auto part = part_of(words);
  if (!part) return misused(part.error());
  add.prop.parts = {*part};
  add.prop.mass_kg = words.mass_kg;
  add.prop.tag = words.tag;
  add.prop.motion = kind_named<PropMotion>(words.motion).value_or(PropMotion::dynamic);
  if (!words.material.empty()) {
    const auto palette = TRY(read_materials(server));
    const auto material = material_named(palette, words.material);
    if (!material) return misused(material.error());
    add.prop.material = *material;
  }
  if (!words.model.empty()) {
    const auto model = model_named(words.model);
    if (!model) return misused(model.error());
    add.prop.model = *model;
  }
  add.place_m = vector_of(words.at_m);
  add.turn = turn_of(words.turn_degrees);
  add.prop.friction = words.friction;
  add.prop.restitution = words.restitution;
  add.prop.gravity = words.gravity;
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

Made move_of(const PropWords& words, const CLI::App& command) {
  MovePropRequest move{words.id};
  if (command.count("--turn") > 0) move.turn = turn_of(words.turn_degrees);
  if (command.count("--at") > 0) move.place_m = vector_of(words.at_m);
  if (command.count("--velocity") > 0) move.velocity_m_s = vector_of(words.velocity_m_s);
  if (command.count("--spin") > 0) move.spin_rad_s = vector_of(words.spin_rad_s);
  if (move == MovePropRequest{words.id})
    return misused({"nothing to change: name --at, --turn, --velocity or --spin"});
  return move;
}

class PropTable {
 public:
  PropTable(CLI::App& app, WorldCommands& table) : app_(app), table_(table) {}

  /// Adds a subcommand. `make(words, command, server)`: its request.
  template <typename Make>
  CLI::App* add(const char* name, const char* what, Make make) {
    CLI::App* const command = app_.add_subcommand(name, what);
    table_.push_back({command, [make, command, words = words_](const AdminServer& server, bool as_json) {
                        return run_request(server, Made(make(*words, *command, server)), as_json);
                      }});
    return command;
  }
  /// One whose request its words say.
  template <typename Make>
  CLI::App* add_plain(const char* name, const char* what, Make make) {
    return add(name, what, [make](const PropWords& words, const CLI::App&, const AdminServer&) {
      return Request(make(words));
    });
  }
  PropWords& words() { return *words_; }

 private:
  CLI::App& app_;
  WorldCommands& table_;
  std::shared_ptr<PropWords> words_ = std::make_shared<PropWords>();
};

void add_addition(PropTable& table) {
  PropWords& words = table.words();
  CLI::App* const add = table.add("add-prop", "adds a body of a game, and prints its id",
                                  [](const PropWords& said, const CLI::App&, const AdminServer& server) {
                                    return addition_of(said, server);
                                  });
  add->add_option("SHAPE", words.shape, "box, sphere, cylinder or capsule; the last two stand upright")
      ->required();
  add->add_option("SIZE", words.size_m,
                  "metres: a box has three sides, a sphere its diameter, the others diameter and length")
      ->required()
      ->expected(1, 3);
  add_place(add, "--at", words.at_m, "X Y Z of its middle, metres")->required();
  add->add_option("--mass", words.mass_kg, "kilograms; 0: by the density of its material")
      ->capture_default_str();
  add->add_option("--material", words.material, "the material by which it is drawn and weighs");
  add->add_option("--model", words.model,
                  "the model that shows it, which the server must have (--models): its file (.glb), or the "
                  "SHA-256 of that");
  add->add_option("--motion", words.motion, "dynamic, kinematic or fixed")
      ->check(CLI::IsMember(std::vector<std::string>{"dynamic", "kinematic", "fixed"}))
      ->capture_default_str();
  add->add_option("--tag", words.tag, "a number of your own");
  add->add_option("--friction", words.friction, "its coefficient, 0 to 4")->capture_default_str();
  add->add_option("--restitution", words.restitution, "how much of a blow's speed comes back, 0 to 1")
      ->capture_default_str();
  add->add_option("--gravity", words.gravity, "its share of gravity; 0: it floats")->capture_default_str();
  CLI::App* const move = table.add("move-prop", "puts a prop elsewhere, or changes its speed",
                                   [](const PropWords& said, const CLI::App& command, const AdminServer&) {
                                     return move_of(said, command);
                                   });
  add_id(move, "ID", words.id, "the id that add-prop printed")->required();
  add_place(move, "--at", words.at_m, "X Y Z, metres");
  for (CLI::App* command : {add, move}) {
    add_place(command, "--turn", words.turn_degrees, "degrees about X, then Y, then Z; Y is up");
    add_place(command, "--velocity", words.velocity_m_s, "metres a second along X Y Z");
    add_place(command, "--spin", words.spin_rad_s, "radians a second about X Y Z");
  }
}

void add_blows(PropTable& table) {
  PropWords& words = table.words();
  CLI::App* const remove = table.add_plain("remove-prop", "takes a prop out of the world",
                                           [](const PropWords& w) { return RemovePropRequest{w.id}; });
  CLI::App* const push =
      table.add_plain("push", "gives a prop or a piece an impulse", [](const PropWords& w) {
        return PushRequest{w.id, vector_of(w.impulse_n_s), vector_of(w.at_m)};
      });
  CLI::App* const broken = table.add_plain("break", "breaks a piece where it is", [](const PropWords& w) {
    return BreakRequest{w.id, vector_of(w.at_m), w.seeds, 1};
  });
  CLI::App* const blast = table.add_plain(
      "blast", "sets energy free at a place: rock breaks, bodies are thrown", [](const PropWords& w) {
        return BlastRequest{vector_of(w.at_m), w.energy_j, 1};
      });
  for (CLI::App* command : {remove, push, broken})
    add_id(command, "ID", words.id, "an id, as list-bodies prints it")->required();
  add_place(push, "--impulse", words.impulse_n_s, "newton seconds along X Y Z")->required();
  for (CLI::App* command : {push, broken})
    add_place(command, "--at", words.at_m, "X Y Z of a place of the body, metres")->required();
  broken->add_option("--seeds", words.seeds, "into how many pieces it breaks")->capture_default_str();
  add_place(blast, "--at", words.at_m, "X Y Z, metres")->required();
  blast->add_option("--energy", words.energy_j, "joules; a kilogram of TNT has 4.2e6")->capture_default_str();
}

void add_piece_commands(PropTable& table) {
  PropWords& words = table.words();
  CLI::App* const cut_out =
      table.add_plain("cut-out", "makes terrain a body that stays one until it is released",
                      [](const PropWords& w) { return CutOutRequest{shape_of(w)}; });
  CLI::App* const carve =
      table.add_plain("carve-piece", "carves a shape out of a piece where it is", piece_carve_of);
  CLI::App* const release = table.add_plain("release", "lets a body that was cut out become terrain again",
                                            [](const PropWords& w) { return ReleaseRequest{w.id}; });
  for (CLI::App* command : {carve, release})
    add_id(command, "ID", words.id, "the id of the piece")->required();
  for (CLI::App* command : {cut_out, carve}) {
    add_place(command, "--at", words.at_m, "X Y Z of the shape's middle, metres")->required();
    CLI::Option* const radius =
        command->add_option("--radius", words.radius_m, "the radius of a ball, metres")
            ->capture_default_str();
    command->add_option("--half", words.half_m, "X Y Z: half the sides of a box instead, metres")
        ->delimiter(',')
        ->expected(3)
        ->excludes(radius);
  }
  carve->add_option("--seeds", words.seeds, "into how many pieces the shape breaks")->capture_default_str();
}

}  // namespace

void add_prop_commands(CLI::App& app, WorldCommands& table) {
  PropTable props(app, table);
  add_addition(props);
  add_blows(props);
  add_piece_commands(props);
}

}  // namespace scree
