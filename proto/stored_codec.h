// Stored chunks of a ground as bytes, on the wire and in files (proto/ground.proto, CHUNK).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/field/stored_chunks.h"

namespace scree {

/// The tiles below one, by place (BrickLayout::children); nothing where none is stored.
using ChunkChildren = std::array<std::optional<Digest>, 8>;

struct UnpackedChunk {
  ChunkChildren children;
  GeneratedChunk chunk;  ///< of the root: of no account
};

/// `chunk` is null for the root.
std::vector<uint8_t> pack_chunk(TileKey key, const BrickLayout& layout, const ChunkChildren& children,
                                const GeneratedChunk* chunk);

/// Refuses what is not the tile's form. `key` is one of the layout's.
Result<UnpackedChunk> unpack_chunk(std::span<const uint8_t> bytes, TileKey key, const BrickLayout& layout);

}  // namespace scree
