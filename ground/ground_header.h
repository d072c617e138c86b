// What stands at the beginning of a .ground file: an elevation model without its tiles, the place of the
// chunks that are stored, and the hash by which the ground is named.
//
// A file is little-endian. It begins with a header of header_bytes:
//   8 bytes   "SCREEGND"
//   u32       format (1, or 2 where there is a palette or a voxel's own material), columns, rows
//   f32       cell (metres)
//   i32       lowest and highest sample
//   f32       soil below and ice above (metres), the height that y = 0 has in the source (metres)
//   32 bytes  SHA-256 of the coarsest tile
//   u32       1 if there are stored chunks, else 0
//   f32       their voxels (metres)
//   i32       x, y and z of their box's first chunk, and of the one beyond its last
//   32 bytes  SHA-256 of their root
//   u32       in format 2: bytes of the palette (proto/palette_codec.h); 0: the built-in one
//   32 bytes  in format 2: SHA-256 of these; zeros if there are none
//   32 bytes  SHA-256 of all this, the ground's name
//   u64       where the index begins, and where that of stored chunks does; then zeros
// The palette's bytes follow, then the tiles (proto/ground.proto, TILE and CHUNK). Then the index has for
// each tile, by level, z and x, its beginning (u64) and its bytes (u32). The index of stored chunks ends the
// file: their number (u32), and for each its level, x, y and z (i32), its beginning (u64) and its bytes
// (u32).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proto/messages.h"

namespace scree {

inline constexpr size_t header_bytes = 256;
inline constexpr size_t index_entry_bytes = 12;
inline constexpr size_t chunk_entry_bytes = 28;

struct GroundHeader {
  uint32_t format = 1;  ///< the oldest that has a place for all of it, so that equal grounds have one name
  HeightGround ground;
  float zero_m = 0.0F;         ///< height in the source of what is y = 0 here
  uint32_t palette_bytes = 0;  ///< 0: the built-in palette, of which later versions have all rows
  Digest palette{};
  uint64_t index_begins = 0;
  uint64_t chunk_index_begins = 0;  ///< as the end of the other index
};

std::vector<uint8_t> encode(const GroundHeader& header);
/// The error says why this is none: foreign, of another version, cut short, beyond limits.
Result<GroundHeader> decode_header(std::span<const uint8_t> bytes);

/// Names the ground: SHA-256 of the header's fields, and through the coarsest tile's of all tiles.
Digest name_of(const GroundHeader& header);

/// Where a tile stands in the index.
size_t index_of(const HeightLayout& layout, TileKey key);

}  // namespace scree
