// Regions in recordings and files of worlds: as a message of the wire. Internal to this folder.
#pragma once

#include <string>
#include <vector>

#include "proto/wire_values.h"
#include "shared/region/region.h"

namespace scree {

std::string pack_regions(const std::vector<Region>& regions);
/// Refuses what no world has.
std::vector<Region> unpack_regions(const std::string& packed, FieldChecker& check);

}  // namespace scree
