// What stands at the beginning of a .ground file: an elevation model without its tiles, and the hash by which
// the ground is named.
//
// A file, little-endian: the header, of header_bytes: 8 bytes "SCREEGND", u32 version, u32 columns, u32 rows,
// f32 cell (metres), i32 lowest and highest sample, f32 soil below and ice above (metres), f32 the height
// that y = 0 has in the source (metres), 32 bytes SHA-256 of the coarsest tile, u64 where the index begins,
// zeros; then the tiles (proto/ground.proto, TILE); then the index: for each tile, by level, z and x, u64
// where it begins and u32 its bytes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proto/messages.h"

namespace scree {

inline constexpr size_t header_bytes = 128;
inline constexpr size_t index_entry_bytes = 12;

struct GroundHeader {
  HeightGround ground;
  float zero_m = 0.0F;  ///< height in the source of what is y = 0 here
  uint64_t index_begins = 0;
};

std::vector<uint8_t> encode(const GroundHeader& header);
/// The error says why this is none: foreign, of another version, cut short, beyond limits.
Result<GroundHeader> decode_header(std::span<const uint8_t> bytes);

/// Names the ground: SHA-256 of the header's fields, and through the coarsest tile's of all tiles.
Digest name_of(const GroundHeader& header);

/// Where a tile stands in the index.
size_t index_of(const HeightLayout& layout, TileKey key);

}  // namespace scree
