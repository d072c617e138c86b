// Palettes as TOML files that people edit (docs/materials.md). A member that a row leaves out has the number
// of MaterialRow. An error names the file, the line and the row: "materials.toml:14: brick: density 30000 is
// over 25000 kg/m3". Any thread.
#pragma once

#include <string>
#include <string_view>

#include "content/image_folder.h"
#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// A palette, and the images that its rows name.
struct PaletteContent {
  Palette palette;
  ImageFiles files;
};

/// Reads a palette without images. `name` stands for the file in errors.
Result<Palette> read_palette(std::string_view text, const std::string& name);

/// Reads a file and the images that it names.
Result<PaletteContent> read_palette_file(const std::string& path);

/// The name of a palette: the SHA-256 of its bytes (proto/palette_codec.h).
Digest palette_digest(const Palette& palette);

}  // namespace scree
