// A palette as bytes, on the wire and in files (proto/material.proto). Its name is the SHA-256 of these bytes
// (crypto/sha256.h). Any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// Bytes of a palette: 255 rows of about 250 bytes, and room to grow. Above: refused before it is parsed.
inline constexpr size_t palette_bytes_max = size_t{128} << 10;

/// The same palette gives the same bytes. `palette` is valid.
std::vector<uint8_t> encode_palette(const Palette& palette);

/// Refuses what is no palette, and one that validate() refuses. Fields of a later version are skipped, so
/// keep the bytes where their digest matters.
Result<Palette> decode_palette(std::span<const uint8_t> bytes);

}  // namespace scree
