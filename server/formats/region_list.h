// Regions and signs in recordings and files of worlds: as messages of the wire. Internal to this folder.
#pragma once

#include <string>
#include <vector>

#include "proto/wire_values.h"
#include "shared/game/sign.h"
#include "shared/region/region.h"

namespace scree {

std::string pack_regions(const std::vector<Region>& regions);
/// Refuses what no world has.
std::vector<Region> unpack_regions(const std::string& packed, FieldChecker& check);

std::string pack_signs(const std::vector<Sign>& signs);
/// Likewise.
std::vector<Sign> unpack_signs(const std::string& packed, FieldChecker& check);

}  // namespace scree
