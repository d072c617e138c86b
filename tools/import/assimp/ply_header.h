// The header of a PLY file, as far as assimp goes wrong on it. Internal to import/assimp.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// The file with a header that assimp reads right. Where the header's last line does not end in CR and LF, it
/// takes a first byte 0x0A of the data for the rest of that line. It makes room for all that a header
/// promises. The error says that the header has no end, or promises more than the file can hold.
Result<std::string> mended_ply(std::string file);

}  // namespace scree
