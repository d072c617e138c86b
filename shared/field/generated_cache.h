// Generated chunks of a field that are kept: those used since half of the room was filled last, and those
// used before and not since, which are dropped when half of the room is filled again. Not thread-safe.
//
// Invariant: bytes() is what the chunks take in memory, and stays within bytes_max() as far as single chunks
// do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "shared/field/coord.h"
#include "shared/field/generated_chunk.h"

namespace scree {

class GeneratedCache {
 public:
  explicit GeneratedCache(size_t bytes_max) : bytes_max_(bytes_max) {}

  /// The chunk if it is kept; it counts as used. Valid until drops() grows.
  GeneratedChunk* find(ChunkCoord chunk);
  /// Keeps a chunk that is not kept yet.
  GeneratedChunk& add(ChunkCoord chunk, GeneratedChunk generated);
  /// Puts another one in the place of a chunk that is kept.
  void replace(GeneratedChunk& old, GeneratedChunk generated);
  /// Whether the chunk is kept and exact; it does not count as used.
  bool has_exact(ChunkCoord chunk) const;
  /// Changes the bound; drops everything if that is too much for it.
  void bound(size_t bytes_max);

  size_t chunks() const { return used_.chunks.size() + unused_.chunks.size(); }
  size_t bytes() const { return used_.bytes + unused_.bytes; }
  size_t bytes_max() const { return bytes_max_; }
  /// Times that chunks were dropped.
  uint64_t drops() const { return drops_; }

 private:
  using Chunks = std::unordered_map<ChunkCoord, GeneratedChunk, CoordHash>;
  struct Kept {
    Chunks chunks;
    size_t bytes = 0;
  };
  /// Drops what was not used lately, when so many more bytes do not fit beside it.
  void make_room(size_t bytes);

  Kept used_;
  Kept unused_;
  size_t bytes_max_;
  uint64_t drops_ = 0;
};

}  // namespace scree
