#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

double m3_of(MassUnits mass, const WorldFacts& world) {
  const double voxel_m = world.voxel_size_m;
  return static_cast<double>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
}

std::string name_of_row(const WorldFacts& world, Material material) {
  return world.palette.has(material) ? std::string(world.palette.name(material))
                                     : std::to_string(row_number(material));
}

}  // namespace

std::string stores_json(const AdminListMessage& list, const WorldFacts& world) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [store, masses] : list.stores) {
    nlohmann::ordered_json one{{"kind", name_of(store.kind)}};
    if (store.kind == StoreKind::named) one["name"] = store.name;
    if (store.kind == StoreKind::session) one["session"] = store.number;
    if (store.kind == StoreKind::token) one["token"] = fmt::format("{:016x}", store.number);
    for (const MaterialMass& mass : masses) one["units"][name_of_row(world, mass.material)] = mass.mass;
    all.push_back(std::move(one));
  }
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string stores_lines(const AdminListMessage& list, const WorldFacts& world) {
  std::string lines;
  for (const auto& [store, masses] : list.stores)
    for (const MaterialMass& mass : masses)
      lines += fmt::format("{}: {:.3f} m³ of {}\n", text_of(store), m3_of(mass.mass, world),
                           name_of_row(world, mass.material));
  if (list.left_out > 0) lines += fmt::format("and {} stores more\n", list.left_out);
  return lines.empty() ? "nothing is stored\n" : lines;
}

}  // namespace scree
