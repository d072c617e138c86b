// The regions of a server's world, in lines and as JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/listed.h"

namespace scree {

namespace {

using RegionJson = nlohmann::ordered_json;

std::vector<std::string_view> forbidden_by(const Region& region) {
  std::vector<std::string_view> names;
  for (const RegionRule& rule : region_rules)
    if (region.forbids_any(rule.bit)) names.push_back(rule.name);
  return names;
}

RegionJson triple_of(glm::vec3 v) {
  return RegionJson::array({v.x, v.y, v.z});
}

RegionJson json_of_region(const Region& region) {
  RegionJson json{{"id", region.id},
                  {"name", region.name},
                  {"form", name_of(region.form)},
                  {"centre_m", triple_of(region.centre_m)},
                  {"half_m", triple_of(region.half_m)},
                  {"forbids", forbidden_by(region)},
                  {"editors", name_of(region.editors)}};
  if (region.editors == RegionEditors::role) json["role"] = name_of(region.role);
  if (region.editors == RegionEditors::persons) {
    json["persons"] = region.persons;
    json["teams"] = region.teams;
  }
  json["tells"] = region.tells;
  json["counts"] = region.counts;
  if (region.until != 0) json["until"] = region.until;
  return json;
}

std::string form_of(const Region& region) {
  const glm::vec3 half = region.half_m, at = region.centre_m;
  const std::string place = fmt::format("at {:g}, {:g}, {:g}", at.x, at.y, at.z);
  switch (region.form) {
    case RegionForm::box:
      return fmt::format("box of {:g} x {:g} x {:g} m {}", 2.0F * half.x, 2.0F * half.y, 2.0F * half.z,
                         place);
    case RegionForm::sphere:
      return fmt::format("sphere of {:g} m {}", 2.0F * half.x, place);
    case RegionForm::cylinder:
      return fmt::format("cylinder of {:g} m, {:g} m high, {}", 2.0F * half.x, 2.0F * half.y, place);
  }
  return {};
}

std::string editors_of(const Region& region) {
  if (region.editors == RegionEditors::role) return fmt::format("role {} and above", name_of(region.role));
  if (region.editors != RegionEditors::persons) return std::string(name_of(region.editors));
  std::vector<std::string> who = region.persons;
  for (const std::string& team : region.teams) who.push_back("team " + team);
  return who.empty() ? "nobody" : fmt::format("{}", fmt::join(who, ", "));
}

std::string words_of_region(const Region& region) {
  const auto forbidden = forbidden_by(region);
  std::string line =
      fmt::format("{}: {}; forbids {}", region.name, form_of(region),
                  forbidden.empty() ? "nothing" : fmt::format("{}", fmt::join(forbidden, ", ")));
  if (region.forbids_any(forbids::edits)) line += "; may edit: " + editors_of(region);
  if (region.tells) line += "; tells who enters and leaves";
  if (region.counts) line += "; counts its rock";
  if (region.until != 0) line += fmt::format("; until tick {}", region.until);
  return line;
}

}  // namespace

std::string regions_json(const std::vector<Region>& regions) {
  RegionJson json = RegionJson::array();
  for (const Region& region : regions) json.push_back(json_of_region(region));
  return json.dump(2) + "\n";
}

std::string regions_lines(const std::vector<Region>& regions) {
  std::string lines;
  for (const Region& region : regions) lines += words_of_region(region) + "\n";
  return lines;
}

}  // namespace scree
