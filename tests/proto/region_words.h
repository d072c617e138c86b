// Regions in words, as message_words.h.
#pragma once

#include "tests/proto/message_words.h"

namespace scree {

inline std::string words(const Region& region) {
  std::string all = fmt::format("region {} '{}': {} at {}, half {}, forbids 0x{:x}, editors {}", region.id,
                                region.name, name_of(region.form), words(region.centre_m),
                                words(region.half_m), region.forbids, name_of(region.editors));
  if (region.editors == RegionEditors::role) all += fmt::format(" {}", name_of(region.role));
  for (const std::string& person : region.persons) all += fmt::format(" '{}'", person);
  for (const std::string& team : region.teams) all += fmt::format(" team '{}'", team);
  if (region.counts) all += ", counts";
  return all + fmt::format(", {}, until {}", region.tells ? "tells" : "silent", region.until);
}
inline Lines describe(const SetRegionMessage& m) {
  return {fmt::format("set region: request {}, for {} s", m.request, m.lasts_s), words(m.region)};
}
inline Lines describe(const RemoveRegionMessage& m) {
  return {fmt::format("remove region: request {}, '{}'", m.request, m.name)};
}
inline Lines describe(const RegionsMessage& m) {
  Lines lines{fmt::format("regions: {}", m.regions.size())};
  for (const Region& region : m.regions) lines.push_back(words(region));
  return lines;
}

}  // namespace scree
