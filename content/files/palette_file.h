// Palettes as files, with the images that their rows name, and the names that palettes have on the wire. Any
// thread.
#pragma once

#include <string>

#include "content/files/image_folder.h"
#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// A palette, and the images that its rows name.
struct PaletteContent {
  Palette palette;
  ImageFiles files;
};

/// Reads a file (content/palette_text.h) and the images that it names.
Result<PaletteContent> read_palette_file(const std::string& path);

/// The name of a palette: the SHA-256 of its bytes (proto/palette_codec.h).
Digest palette_digest(const Palette& palette);

}  // namespace scree
