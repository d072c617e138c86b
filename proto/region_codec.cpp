#include "proto/region_codec.h"

#include <fmt/format.h>
#include <set>
#include <utility>

#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

static_assert(wire::RegionForm_ARRAYSIZE == kind_count<RegionForm>);
static_assert(wire::RegionEditors_ARRAYSIZE == kind_count<RegionEditors>);

void write_region(wire::Region& to, const Region& from) {
  to.set_id(from.id);
  to.set_name(from.name);
  to.set_form(static_cast<wire::RegionForm>(from.form));
  scree::write(*to.mutable_centre(), from.centre_m);
  scree::write(*to.mutable_half(), from.half_m);
  to.set_forbids(from.forbids);
  to.set_editors(static_cast<wire::RegionEditors>(from.editors));
  to.set_role(static_cast<wire::Role>(from.role));
  for (const std::string& person : from.persons) to.add_persons(person);
  for (const std::string& team : from.teams) to.add_teams(team);
  to.set_tells(from.tells);
  to.set_counts(from.counts);
  to.set_until(from.until);
}

/// As it came: a world refuses what it cannot have (validate).
Region read_region(const wire::Region& from, FieldChecker& check) {
  Region region;
  region.id = from.id();
  region.name = check.bytes(from.name(), limits::client_message_bytes_max, "name of a region");
  region.form = check.asked_kind<RegionForm>(from.form(), "form of a region");
  region.centre_m = check.vec3(from.centre(), "middle of a region");
  region.half_m = check.vec3(from.half(), "size of a region");
  region.forbids = static_cast<uint8_t>(check.within(from.forbids(), 0, UINT8_MAX, "what a region forbids"));
  region.editors = check.asked_kind<RegionEditors>(from.editors(), "kind of who may edit in a region");
  region.role = check.asked_kind<Role>(from.role(), "role");
  for (const std::string& person : from.persons())
    region.persons.push_back(
        check.bytes(person, limits::client_message_bytes_max, "name of a region's person"));
  for (const std::string& team : from.teams())
    region.teams.push_back(check.bytes(team, limits::client_message_bytes_max, "name of a region's team"));
  region.tells = from.tells();
  region.counts = from.counts();
  region.until = from.until();
  return region;
}

}  // namespace

void write(wire::SetRegion& to, const SetRegionMessage& from) {
  to.set_request(from.request);
  write_region(*to.mutable_region(), from.region);
  to.set_lasts_s(from.lasts_s);
}

void write(wire::RemoveRegion& to, const RemoveRegionMessage& from) {
  to.set_request(from.request);
  to.set_name(from.name);
}

void write(wire::Regions& to, const RegionsMessage& from) {
  CHECK(from.regions.size() <= limits::regions_max);
  for (const Region& one : from.regions) write_region(*to.add_regions(), one);
}

SetRegionMessage read(const wire::SetRegion& from, FieldChecker& check) {
  return {{read_region(from.region(), check), check.finite(from.lasts_s(), "lasts_s of a region")},
          from.request()};
}

RemoveRegionMessage read(const wire::RemoveRegion& from, FieldChecker& check) {
  return {{check.bytes(from.name(), limits::client_message_bytes_max, "name of a region")}, from.request()};
}

RegionsMessage read(const wire::Regions& from, FieldChecker& check) {
  RegionsMessage message;
  if (static_cast<size_t>(from.regions_size()) > limits::regions_max)
    check.refuse(
        fmt::format("{} regions are over the limit of {}", from.regions_size(), limits::regions_max));
  std::set<std::string> names;
  for (const wire::Region& one : from.regions()) {
    if (check.failed()) break;
    Region region = read_region(one, check);
    if (!check.unknown().empty()) check.refuse(check.unknown() + " is unknown");
    if (const Result<void> valid = validate(region); !valid) check.refuse(valid.error().message);
    if (region.id == 0 || (!message.regions.empty() && region.id <= message.regions.back().id))
      check.refuse("the ids of regions do not ascend");
    if (!names.insert(region.name).second) check.refuse("two regions have the same name");
    message.regions.push_back(std::move(region));
  }
  return message;
}

}  // namespace scree
