// Palettes as TOML that people write (docs/materials.md). A member that a row leaves out has the number of
// MaterialRow. An error names the file, the line and the row: "materials.toml:14: brick: density 30000 is
// over 25000 kg/m3". Any thread.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// Reads an image that a row names, and says its SHA-256.
using ReadImage = std::function<Result<Digest>(const std::string& path)>;

/// `name` stands for the file in errors. Without `read_image`, a row that names an image is refused.
Result<Palette> read_palette(std::string_view text, const std::string& name,
                             const ReadImage& read_image = {});

}  // namespace scree
