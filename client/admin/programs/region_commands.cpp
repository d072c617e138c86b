// region add, region list, region show and region remove.
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "shared/base/option_check.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

/// Metres.
struct RegionWords {
  std::string name, form;
  std::vector<float> size_m;
  Place at_m{};
  std::vector<std::string> forbid, editors;
  bool tells = false, counts = false;
  float lasts_s = 0.0F;
};

/// A box by its sides, others by diameter and height.
Result<void> enter_form(Region& region, const RegionWords& words) {
  region.form = kind_named<RegionForm>(words.form).value_or(RegionForm::box);
  const std::vector<float>& size = words.size_m;
  const auto of = [&](size_t numbers, const char* which) -> Result<void> {
    if (size.size() == numbers) return {};
    return fail(fmt::format("a {} has {}", words.form, which));
  };
  switch (region.form) {
    case RegionForm::box:
      TRY(of(3, "three sides: X Y Z"));
      region.half_m = 0.5F * glm::vec3(size[0], size[1], size[2]);
      return {};
    case RegionForm::sphere:
      TRY(of(1, "a diameter"));
      region.half_m = glm::vec3(0.5F * size[0]);
      return {};
    case RegionForm::cylinder:
      TRY(of(2, "a diameter and a height"));
      region.half_m = 0.5F * glm::vec3(size[0], size[1], size[0]);
      return {};
  }
  return {};
}

Result<void> enter_editors(Region& region, const std::vector<std::string>& editors) {
  if (editors.empty()) return {};
  const std::string& first = editors.front();
  if (editors.size() == 1 && (first == "nobody" || first == "all")) {
    region.editors = *kind_named<RegionEditors>(first);
    return {};
  }
  if (const auto role = kind_named<Role>(first); role && editors.size() == 1) {
    region.editors = RegionEditors::role;
    region.role = *role;
    return {};
  }
  region.editors = RegionEditors::persons;
  for (const std::string& person : editors) {
    constexpr std::string_view name = "name:", team = "team:";
    if (person.starts_with(name))
      region.persons.push_back(person.substr(name.size()));
    else if (person.starts_with(team))
      region.teams.push_back(person.substr(team.size()));
    else
      return fail("'" + person +
                  "' is none of: nobody, all, a role, name:NAME of a person, team:NAME of a team");
  }
  return {};
}

Made addition_of(const RegionWords& words) {
  SetRegionRequest set;
  set.region.name = words.name;
  set.region.centre_m = vector_of(words.at_m);
  set.region.tells = words.tells;
  set.region.counts = words.counts;
  set.lasts_s = words.lasts_s;
  for (const std::string& name : words.forbid) {
    const auto rule = std::ranges::find(region_rules, name, &RegionRule::name);
    if (rule == region_rules.end()) return misused({"'" + name + "' is none of edits, dents, falls, pieces"});
    set.region.forbids |= rule->bit;
  }
  if (const Result<void> form = enter_form(set.region, words); !form) return misused(form.error());
  if (const Result<void> who = enter_editors(set.region, words.editors); !who) return misused(who.error());
  if (const Result<void> valid = validate(set.region); !valid) return misused(valid.error());
  return set;
}

void add_words_of_region(CLI::App* add, RegionWords& words) {
  add->add_option("NAME", words.name, "its name; a region of that name is replaced")->required();
  add->add_option("FORM", words.form, "box, sphere or cylinder, which stands upright")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>{"box", "sphere", "cylinder"}));
  add->add_option("SIZE", words.size_m,
                  "metres: a box has three sides, a sphere its diameter, a cylinder diameter and height")
      ->required()
      ->expected(1, 3);
  add_place(add, "--at", words.at_m, "X Y Z of its middle, metres")->required();
  add->add_option("--forbid", words.forbid,
                  "edits, dents, falls or pieces, with commas between: what must not happen in it")
      ->delimiter(',');
  add->add_option("--editors", words.editors,
                  "who may edit where edits are forbidden: nobody, all, a role, or name:NAME of each person "
                  "and team:NAME of each team, as access tokens state them")
      ->delimiter(',');
  add->add_flag("--tells", words.tells, "bodies that enter and leave it are events");
  add->add_flag("--counts", words.counts, "what becomes of its rock is counted (region mass)");
  bounded(add->add_option("--for", words.lasts_s, "seconds that it lasts; 0: until it is removed"),
          {0.0, limits::region_lasts_max_s})
      ->capture_default_str();
}

Printed list(const AdminServer& server, const std::optional<glm::vec3>& at_m, bool as_json) {
  auto regions = TRY(list_regions(server));
  if (at_m) std::erase_if(regions, [&](const Region& region) { return !holds(region, *at_m); });
  return as_json ? regions_json(regions) : regions_lines(regions);
}

Printed show(const AdminServer& server, const std::string& name, bool as_json) {
  auto regions = TRY(list_regions(server));
  std::erase_if(regions, [&](const Region& region) { return region.name != name; });
  if (regions.empty()) return tl::unexpected(Failed(Error{"there is no region '" + name + "'"}));
  return as_json ? regions_json(regions) : regions_lines(regions);
}

Printed masses(const AdminServer& server, const std::string& name, bool as_json) {
  const auto regions = TRY(list_regions(server));
  if (!name.empty()) {
    const auto region = std::ranges::find(regions, name, &Region::name);
    if (region == regions.end()) return tl::unexpected(Failed(Error{"there is no region '" + name + "'"}));
    if (!region->counts)
      return tl::unexpected(
          Failed(Error{"the region '" + name + "' does not count its rock: add it with --counts"}));
  }
  const auto list = TRY(list_region_masses(server, name));
  const auto world = TRY(read_world(server));
  return as_json ? region_masses_json(list, regions, world) : region_masses_lines(list, regions, world);
}

}  // namespace

void add_region_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<RegionWords>();
  CLI::App* const all =
      app.add_subcommand("region", "manages places in which the world forbids what happens elsewhere");
  all->require_subcommand(1);
  all->fallthrough();
  CLI::App* const add = all->add_subcommand("add", "adds a region, or replaces the one of its name");
  CLI::App* const listed = all->add_subcommand("list", "lists all regions");
  CLI::App* const shown = all->add_subcommand("show", "prints one region");
  CLI::App* const mass = all->add_subcommand("mass", "prints what became of the rock of regions that count");
  mass->add_option("NAME", words->name, "the region's name; none: all of them");
  CLI::App* const remove = all->add_subcommand("remove", "removes a region");
  add_words_of_region(add, *words);
  add_place(listed, "--at", words->at_m, "X Y Z: only those in which this place lies");
  for (CLI::App* command : {shown, remove})
    command->add_option("NAME", words->name, "the region's name")->required();
  table.push_back({add, [words](const AdminServer& server, bool as_json) {
                     return run_request(server, addition_of(*words), as_json);
                   }});
  table.push_back({listed, [words, listed](const AdminServer& server, bool as_json) {
                     std::optional<glm::vec3> at_m;
                     if (listed->count("--at") > 0) at_m = vector_of(words->at_m);
                     return list(server, at_m, as_json);
                   }});
  table.push_back({shown, [words](const AdminServer& server, bool as_json) {
                     return show(server, words->name, as_json);
                   }});
  table.push_back({mass, [words](const AdminServer& server, bool as_json) {
                     return masses(server, words->name, as_json);
                   }});
  table.push_back({remove, [words](const AdminServer& server, bool as_json) {
                     return run_request(server, Request(RemoveRegionRequest{words->name}), as_json);
                   }});
}

}  // namespace scree
