// The first fault of an OBJ's file of materials (.mtl) that stops assimp, whose own words name neither the
// file nor the line. Internal to import/assimp.
#pragma once

#include <optional>
#include <string>

namespace scree {

/// "beside.mtl:3: 'Kd' stands without its numbers"; nothing: the file has no such fault.
std::optional<std::string> fault_of_materials(const std::string& path);

}  // namespace scree
