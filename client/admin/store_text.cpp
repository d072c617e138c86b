// What is stored, and what became of the rock of regions, in lines and as JSON.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/field/mass.h"

namespace scree {

double m3_of(MassUnits mass, const WorldFacts& world) {
  const double voxel_m = world.voxel_size_m;
  return static_cast<double>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
}

namespace {

double kg_of(MassUnits mass, Material material, const WorldFacts& world) {
  return m3_of(mass, world) * static_cast<double>(world.palette.row_or_first(material).density_kg_m3);
}

std::string name_of_row(const WorldFacts& world, Material material) {
  return world.palette.has(material) ? std::string(world.palette.name(material))
                                     : std::to_string(row_number(material));
}

std::string name_of_region(RegionId id, const std::vector<Region>& regions) {
  const auto found = std::ranges::find(regions, id, &Region::id);
  return found == regions.end() ? fmt::format("region {}", id) : found->name;
}

struct MassColumn {
  const char* json;
  const char* words;
  MassUnits RegionMass::*mass;
};
constexpr std::array mass_columns = {
    MassColumn{"pieces", "in pieces", &RegionMass::pieces}, MassColumn{"dust", "dust", &RegionMass::dust},
    MassColumn{"carried", "carried", &RegionMass::carried}, MassColumn{"back", "back", &RegionMass::back},
    MassColumn{"away", "elsewhere", &RegionMass::away}};

}  // namespace

std::string region_masses_json(const AdminListMessage& list, const std::vector<Region>& regions,
                               const WorldFacts& world) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const RegionMass& mass : list.region_masses) {
    nlohmann::ordered_json one{{"region", name_of_region(mass.origin.region, regions)},
                               {"party", mass.origin.party},
                               {"material", name_of_row(world, mass.material)},
                               {"cut", mass.cut}};
    for (const MassColumn& column : mass_columns) one[column.json] = mass.*column.mass;
    one["cut_kg"] = kg_of(mass.cut, mass.material, world);
    all.push_back(std::move(one));
  }
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string region_masses_lines(const AdminListMessage& list, const std::vector<Region>& regions,
                                const WorldFacts& world) {
  std::string lines;
  for (const RegionMass& mass : list.region_masses) {
    const std::string whose =
        mass.origin.party == 0 ? "the world" : fmt::format("session {}", mass.origin.party);
    lines += fmt::format(
        "{}: {} broke {:.3f} m³ of {}, {:.0f} kg:", name_of_region(mass.origin.region, regions), whose,
        m3_of(mass.cut, world), name_of_row(world, mass.material), kg_of(mass.cut, mass.material, world));
    const char* between = " ";
    for (const MassColumn& column : mass_columns) {
      if (mass.*column.mass == 0) continue;
      lines += fmt::format("{}{} {:.3f}", between, column.words, m3_of(mass.*column.mass, world));
      between = ", ";
    }
    lines += "\n";
  }
  if (list.left_out > 0) lines += fmt::format("and {} rows more\n", list.left_out);
  return lines.empty() ? "nothing was broken out of a region that counts\n" : lines;
}

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
  if (list.left_out > 0) all.push_back({{"left_out", list.left_out}});
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
