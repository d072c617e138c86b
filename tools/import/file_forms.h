// Forms of files by the ends of their names: what import reads as what, and words for forms that it does not
// read.
#pragma once

#include <optional>
#include <string>

namespace scree {

/// The end of the name in lower case, with its dot.
std::string ending_of(const std::string& path);

bool is_mesh_file(const std::string& path);
bool is_volume_file(const std::string& path);
bool is_voxels_file(const std::string& path);

/// Why a file of that name cannot be imported, and the way out; nothing for meshes, volumes, and all that
/// GDAL may know.
std::optional<std::string> refusal_of_form(const std::string& path);

}  // namespace scree
