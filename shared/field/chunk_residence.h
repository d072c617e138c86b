// Which edited chunks of a field are in memory, and how the others come back. A field that does not page has
// none of this. Not thread-safe.
//
// Invariant: chunks() are the field's edited chunks that are not out, and bricks() counts their edited
// bricks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "shared/base/check.h"
#include "shared/field/coord.h"
#include "shared/field/paging.h"

namespace scree {

class ChunkResidence {
 public:
  using Chunks = std::unordered_set<ChunkCoord, CoordHash>;

  /// From now on the field pages, by this way to read a chunk; not null.
  void page_by(ReadChunk read) { read_ = std::move(read); }
  bool pages() const { return read_ != nullptr; }

  /// A chunk with so many edited bricks is in memory from now on, or is not any more.
  void enter(ChunkCoord chunk, size_t bricks) {
    chunks_.insert(chunk);
    bricks_ += bricks;
  }
  void leave(ChunkCoord chunk, size_t bricks) {
    CHECK(bricks_ >= bricks);
    chunks_.erase(chunk);
    bricks_ -= bricks;
  }
  /// A chunk in memory has one more edited brick.
  void add_brick() { ++bricks_; }
  /// Reads a chunk that somebody waits for.
  Result<std::vector<BrickPatch>> read(ChunkCoord chunk) {
    ++waits_;
    return read_(chunk);
  }

  const Chunks& chunks() const { return chunks_; }
  size_t bricks() const { return bricks_; }
  /// Times that somebody waited for a chunk.
  uint64_t waits() const { return waits_; }
  /// A turn is a tick: by turns it is known which chunks nobody asked for lately.
  uint64_t turn() const { return turn_; }
  void begin_turn() { ++turn_; }

 private:
  ReadChunk read_;  ///< null: all chunks are in
  Chunks chunks_;
  size_t bricks_ = 0;
  uint64_t turn_ = 0;
  uint64_t waits_ = 0;
};

}  // namespace scree
