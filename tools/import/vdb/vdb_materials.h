// What the numbers of an OpenVDB grid of materials stand for. Internal to import/vdb.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "tools/import/import_palette.h"

namespace scree {

/// By `map`, which has names or numbers, or else by the names in the grid's metadata, a line each; without
/// names, numbers are rows of the palette. Names of `occurring` numbers that the palette lacks become rows of
/// it: as in `packed`, the palette of the file, or else with the numbers of any row. `map_used` gets the keys
/// of the map that occurring numbers have.
Result<std::vector<VoxelMaterial>> rows_of_numbers(std::span<const uint8_t> names,
                                                   std::span<const uint8_t> packed,
                                                   const std::set<int32_t>& occurring, const MaterialMap& map,
                                                   ImportPalette& palette, std::set<std::string>& map_used);

}  // namespace scree
