// stores, dig, place and transfer.
#include <charconv>
#include <cmath>
#include <memory>

#include "client/admin/programs/world_commands.h"

namespace scree {

namespace {

/// What these were told. Metres, cubic metres.
struct StoreWords {
  Place at_m{};
  std::vector<float> half_m;  ///< of a box; else a ball of this radius
  float radius_m = 1.0F;
  PieceId piece = 0;
  std::string store = "world", from, to, material;
  bool solid = false;
  double volume_m3 = 0.0;
};

Shape shape_of(const StoreWords& words) {
  const glm::vec3 at_m = vector_of(words.at_m);
  if (words.half_m.empty()) return sphere(at_m, words.radius_m);
  return box(at_m, {words.half_m[0], words.half_m[1], words.half_m[2]});
}

Result<uint64_t> number_of(std::string_view text, int base) {
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  return fail("'" + std::string(text) + "' is no number of a session, and no id of a token");
}

/// own, world, session:NUMBER, token:ID or a name that the game gives.
Result<StoreName> store_named(const std::string& text) {
  const std::string_view rest = std::string_view(text).substr(std::min(text.size(), text.find(':') + 1));
  StoreName store = named_store(text);
  if (text == "own") store = {};
  if (text == "world") store = worlds_store();
  if (text.starts_with("session:")) store = {StoreKind::session, TRY(number_of(rest, 10))};
  if (text.starts_with("token:")) store = {StoreKind::token, TRY(number_of(rest, 16))};
  TRY(validate(store));
  return store;
}

Made dig_of(const StoreWords& words) {
  const auto store = store_named(words.store);
  if (!store) return misused(store.error());
  return DigRequest{shape_of(words), words.piece, *store};
}

Made place_of(const StoreWords& words, const WorldFacts& world) {
  const auto store = store_named(words.store);
  if (!store) return misused(store.error());
  const auto material = material_named(world.palette, words.material);
  if (!material) return misused(material.error());
  return PlaceRequest{shape_of(words), *material, words.solid, *store};
}

Made transfer_of(const StoreWords& words, const WorldFacts& world) {
  TransferRequest transfer;
  const auto from = store_named(words.from), to = store_named(words.to);
  if (!from) return misused(from.error());
  if (!to) return misused(to.error());
  transfer.from = *from;
  transfer.to = *to;
  if (words.material.empty() && words.volume_m3 != 0.0)
    return misused({"a volume is of one material: say --material, too"});
  if (words.material.empty()) return transfer;
  const auto material = material_named(world.palette, words.material);
  if (!material) return misused(material.error());
  transfer.material = *material;
  const double units = words.volume_m3 / m3_of(1, world);
  if (!(units >= 0.0 && units < 1e15)) return misused({"a volume is a number of cubic metres, 0 for all"});
  transfer.mass = std::llround(units);
  if (transfer.mass == 0 && words.volume_m3 > 0.0)
    return misused({"the volume is less than a unit of mass, and none is all: say more"});
  return transfer;
}

void add_shape(CLI::App* command, StoreWords& words) {
  add_place(command, "--at", words.at_m, "X Y Z of the shape's middle, metres")->required();
  CLI::Option* const radius =
      command->add_option("--radius", words.radius_m, "the radius of a ball, metres")->capture_default_str();
  command->add_option("--half", words.half_m, "X Y Z: half the sides of a box instead, metres")
      ->delimiter(',')
      ->expected(3)
      ->excludes(radius);
  command
      ->add_option("--store", words.store,
                   "own, world, session:NUMBER, token:ID, or a name of the game's; a director's but for own")
      ->capture_default_str();
}

}  // namespace

void add_store_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<StoreWords>();
  CLI::App* const stores = app.add_subcommand("stores", "lists what was dug and not placed since, by owner");
  CLI::App* const dig = app.add_subcommand("dig", "takes terrain, or a piece, into a store");
  CLI::App* const place = app.add_subcommand("place", "fills a shape out of a store");
  CLI::App* const transfer = app.add_subcommand("transfer", "moves rock from a store to another");
  for (CLI::App* command : {dig, place}) add_shape(command, *words);
  add_id(dig, "--piece", words->piece, "the id of a piece that goes as a whole; --at is its place");
  for (CLI::App* command : {place, transfer})
    command->add_option("--material", words->material, "the material; of a transfer, none is all of them");
  place->get_option("--material")->required();
  place->add_flag("--solid", words->solid, "as solid rock, not as rubble");
  transfer->add_option("--from", words->from, "the store that gives, as of dig --store")->required();
  transfer->add_option("--to", words->to, "the store that takes")->required();
  transfer->add_option("--volume", words->volume_m3, "cubic metres of the material; 0: all of it")
      ->capture_default_str();
  table.push_back({stores, [](const AdminServer& server, bool as_json) -> Printed {
                     const auto list = TRY(list_stores(server));
                     const auto world = TRY(read_world(server));
                     return as_json ? stores_json(list, world) : stores_lines(list, world);
                   }});
  table.push_back({dig, [words](const AdminServer& server, bool as_json) {
                     return run_request(server, dig_of(*words), as_json);
                   }});
  table.push_back({place, [words](const AdminServer& server, bool as_json) -> Printed {
                     const auto world = TRY(read_world(server));
                     return run_request(server, place_of(*words, world), as_json);
                   }});
  table.push_back({transfer, [words](const AdminServer& server, bool as_json) -> Printed {
                     const auto world = TRY(read_world(server));
                     return run_request(server, transfer_of(*words, world), as_json);
                   }});
}

}  // namespace scree
