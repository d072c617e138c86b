// Tiles of elevation models as bytes, on the wire and in files (proto/ground.proto, TILE).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/field/heights.h"

namespace scree {

struct UnpackedTile {
  std::vector<Digest> children;  ///< of HeightLayout::children(), in order
  HeightTile tile;
};

std::vector<uint8_t> pack_tile(const std::vector<Digest>& children, const HeightTile& tile);

/// Refuses what is not the tile's form, and heights beyond the layout's. `key` is one of the layout's.
Result<UnpackedTile> unpack_tile(std::span<const uint8_t> bytes, TileKey key, const HeightLayout& layout);

}  // namespace scree
