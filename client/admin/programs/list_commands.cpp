// list-bodies and list-joints.
#include <glm/geometric.hpp>
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

/// Where to look. Metres.
struct WhereWords {
  Place lo_m{}, hi_m{}, at_m{};
  float radius_m = 10.0F;
};

void add_where(CLI::App* command, WhereWords& words) {
  CLI::Option* const lo = add_place(command, "--lo", words.lo_m, "X Y Z: the lower corner of a box, metres");
  CLI::Option* const hi = add_place(command, "--hi", words.hi_m, "X Y Z: the upper corner of the box");
  CLI::Option* const at = add_place(command, "--at", words.at_m, "X Y Z: near this place instead");
  lo->needs(hi);
  hi->needs(lo);
  at->excludes(lo);
  bounded(command->add_option("--radius", words.radius_m, "how near, metres"), NumberWithin{0.0, 1e5})
      ->needs(at)
      ->capture_default_str();
}

bool is_near(const CLI::App& command) {
  return command.count("--at") > 0;
}

/// Nothing: everywhere.
using Where = tl::expected<std::optional<PlacesWithin>, Failed>;

Where within(const WhereWords& words, const CLI::App& command) {
  if (is_near(command)) {
    const glm::vec3 at_m = vector_of(words.at_m);
    return PlacesWithin{at_m - words.radius_m, at_m + words.radius_m};
  }
  if (command.count("--lo") == 0) return std::nullopt;
  for (size_t axis = 0; axis < 3; ++axis)
    if (!(words.lo_m[axis] <= words.hi_m[axis]))
      return misused({"the box's lower corner is above its upper one, or no number"});
  return PlacesWithin{vector_of(words.lo_m), vector_of(words.hi_m)};
}

}  // namespace

void add_list_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<WhereWords>();
  CLI::App* const bodies =
      app.add_subcommand("list-bodies", "lists pieces and props: id, kind, place, speed, mass and tag");
  CLI::App* const joints = app.add_subcommand("list-joints", "lists joints");
  for (CLI::App* command : {bodies, joints}) add_where(command, *words);
  table.push_back({bodies, [words, bodies](const AdminServer& server, bool as_json) -> Printed {
                     const auto where = TRY(within(*words, *bodies));
                     auto list = list_bodies(server, {where, {}});
                     if (list && is_near(*bodies))
                       std::erase_if(list->bodies, [&](const BodyRow& row) {
                         return glm::distance(dequantise(row.pose).position_m, vector_of(words->at_m)) >
                                words->radius_m;
                       });
                     return print_said(list, as_json ? bodies_json : bodies_lines);
                   }});
  table.push_back({joints, [words, joints](const AdminServer& server, bool as_json) -> Printed {
                     const auto where = TRY(within(*words, *joints));
                     return print_said(list_joints(server, {where}), as_json ? joints_json : joints_lines);
                   }});
}

}  // namespace scree
