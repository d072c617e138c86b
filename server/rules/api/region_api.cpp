// Regions, the ledger, and stores of rock.
#include <algorithm>
#include <map>

#include "server/rules/api/asking.h"
#include "server/rules/request_fields.h"

namespace scree {

namespace {

Result<void> set_region(RulesCall& call) {
  return ask_by_table(call, "set_region");
}

Result<void> remove_region(RulesCall& call) {
  RemoveRegionRequest request{std::string(TRY(call.argument(1, "name").text()))};
  return ask_world(call, std::move(request), 0, 2);
}

void write_region(RulesCall& call, const Region& region) {
  ScriptWriter& to = call.results();
  SetRegionRequest as_asked{region};
  const World& world = world_of(call);
  if (region.until > world.tick())
    as_asked.lasts_s =
        static_cast<float>(region.until - world.tick()) / static_cast<float>(world.config().tick_rate_hz);
  to.open_table();
  write_fields(&as_asked, to, set_region_fields, call.moment);
  to.close_table();
}

const Region* region_named(const RulesCall& call, std::string_view name) {
  const std::vector<Region>& regions = world_of(call).regions();
  const auto found = std::ranges::find(regions, name, &Region::name);
  return found != regions.end() ? &*found : nullptr;
}

Result<void> all_regions(RulesCall& call) {
  const std::vector<Region>& regions = world_of(call).regions();
  call.call.charge(work_of_request * static_cast<int64_t>(regions.size()));
  call.results().open_table();
  for (const Region& region : regions) write_region(call, region);
  call.results().close_table();
  return {};
}

Result<void> get_region(RulesCall& call) {
  call.call.charge(work_of_request);
  if (const Region* const region = region_named(call, TRY(call.argument(1, "name").text())))
    write_region(call, *region);
  else
    call.results().nil();
  return {};
}

Result<void> regions_at_place(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  const std::vector<Region>& regions = world_of(call).regions();
  call.call.charge(work_of_step * static_cast<int64_t>(1 + regions.size()));
  call.results().open_table();
  for (const Region* const region : regions_at(regions, at)) call.results().text(region->name);
  call.results().close_table();
  return {};
}

/// A row of a table whose keys are materials.
void name_material(RulesCall& call, Material material) {
  call.results().name(world_of(call).config().palette->name(material));
}

void write_volume(RulesCall& call, std::string_view name, MassUnits mass) {
  call.results().name(name);
  call.results().number(cubic_metres(mass, call.moment));
}

Result<void> masses(RulesCall& call) {
  const ScriptValue name = call.argument(1, "region");
  const Region* const region = region_named(call, TRY(name.text()));
  if (region == nullptr) return name.refuse("there is no region of that name");
  const std::vector<RegionMass> all = world_of(call).region_masses();
  call.call.charge(work_of_body * static_cast<int64_t>(1 + all.size()));
  ScriptWriter& to = call.results();
  to.open_table();
  for (const RegionMass& mass : all) {
    if (mass.origin.region != region->id) continue;
    to.open_table();
    if (const uint64_t person = call.moment.person_of(mass.origin.party); person != 0) {
      to.name("by");
      write_person(to, person);
    }
    to.name("material");
    write_material(to, mass.material, call.moment);
    write_volume(call, "cut", mass.cut);
    write_volume(call, "pieces", mass.pieces);
    write_volume(call, "dust", mass.dust);
    write_volume(call, "carried", mass.carried);
    write_volume(call, "back", mass.back);
    write_volume(call, "away", mass.away);
    to.close_table();
  }
  to.close_table();
  return {};
}

/// `Row`: of a ledger, or of one material in it.
template <typename Row>
void write_ledger_row(RulesCall& call, const Row& row) {
  call.results().open_table();
  write_volume(call, "terrain", row.terrain);
  write_volume(call, "pieces", row.pieces);
  write_volume(call, "dust", row.dust);
  write_volume(call, "poured", row.poured);
  write_volume(call, "stored", row.stored);
  call.results().close_table();
}

Result<void> ledger(RulesCall& call) {
  const World& world = world_of(call);
  const std::vector<MaterialLedger::Row>& rows = world.materials().rows();
  call.call.charge(work_of_body * static_cast<int64_t>(1 + rows.size()));
  call.results().open_table();
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] == MaterialLedger::Row{}) continue;
    name_material(call, static_cast<Material>(i));
    write_ledger_row(call, rows[i]);
  }
  call.results().close_table();
  write_ledger_row(call, world.ledger());
  return {};
}

Result<void> store_of(RulesCall& call) {
  const StoreName store = TRY(read_store(call.argument(1, "owner"), call.moment));
  const std::vector<StoreContent> stores = world_of(call).stores();
  call.call.charge(work_of_body * static_cast<int64_t>(1 + stores.size()));
  const auto found = std::ranges::find(stores, store, &StoreContent::store);
  double all_m3 = 0.0;
  call.results().open_table();
  if (found != stores.end())
    for (const MaterialMass& mass : found->masses) {
      name_material(call, mass.material);
      all_m3 += cubic_metres(mass.mass, call.moment);
      call.results().number(cubic_metres(mass.mass, call.moment));
    }
  call.results().close_table();
  call.results().number(all_m3);
  return {};
}

constexpr ApiFunction region_rows[] = {
    {"regions", "set", "what: set_region, reply?: fun(reply: reply)", "",
     "Adds a region, or puts it in the place of the one of its name: what it forbids, to whom, and whether "
     "it "
     "tells who enters it and counts its rock.",
     "regions.set{ name = \"home\", form = \"cylinder\", at = vec(0, 0, 0), radius = 8, height = 10,\n"
     "  forbid = { \"edits\", \"dents\" }, tells = true }\n"
     "regions.set{ name = \"quarry\", at = vec(30, 0, 0), half = vec(10, 5, 10), counts = true, lasts = 600 "
     "}",
     set_region},
    {"regions", "remove", "name: string, reply?: fun(reply: reply)", "", "Takes a region away.",
     "regions.remove(\"home\")", remove_region},
    {"regions", "all", "", "set_region[]",
     "All regions, with the fields that `regions.set` takes; `lasts` is what is left.",
     "for _, region in ipairs(regions.all()) do log(region.name) end", all_regions},
    {"regions", "get", "name: string", "set_region?", "The region of that name.",
     "assert(regions.get(\"nowhere\") == nil)", get_region},
    {"regions", "at", "at: vec", "string[]", "The names of the regions in which a place lies.",
     "for _, name in ipairs(regions.at(vec(0, 0, 0))) do log(name) end", regions_at_place},
    {"regions", "masses", "region: string", "region_mass[]",
     "What became of the rock of a region that counts (`counts`), by person and material: m³ that were cut "
     "out, and of these in pieces, as dust, in stores, in the region again, and terrain elsewhere.",
     "if regions.get(\"quarry\") then\n"
     "  for _, row in ipairs(regions.masses(\"quarry\")) do log(row.material .. \": \" .. row.cut) end\n"
     "end",
     masses},
    {"world", "ledger", "", "table<string, ledger_row>, ledger_row",
     "Where the rock is, m³, by material and in all: what the terrain gained since the start (a loss is "
     "negative), what is in pieces, dust and stores, and what was poured in.",
     "local by_material, all = world.ledger()\nlog(\"the terrain lost \" .. -all.terrain .. \" m³\")",
     ledger},
    {"stores", "of", "owner: store", "table<string, number>, number",
     "m³ in a store, by material and in all: of a person, of a name, or \"world\".",
     "local by_material, all = stores.of(\"red\")\nlog(\"red has \" .. all .. \" m³\")", store_of},
};

}  // namespace

std::span<const ApiFunction> region_api() {
  return region_rows;
}

}  // namespace scree
