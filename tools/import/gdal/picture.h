// Pictures in colour, by GDAL: the textures of meshes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// sRGB, rows from the top.
struct Picture {
  int columns = 0;
  int rows = 0;
  std::vector<std::array<uint8_t, 3>> pixels;
};

/// Reads the bytes of a PNG or a JPEG with 8 bits a part. Any other file is refused, and one with too many
/// pixels (limits.picture_pixels_max).
Result<Picture> read_picture(std::span<const uint8_t> file);

}  // namespace scree
