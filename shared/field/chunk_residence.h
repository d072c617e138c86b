// Which edited chunks of a field are in memory, and how the others come back. A field that does not page has
// none of this. Not thread-safe.
//
// Invariant: chunks() are the field's edited chunks that are not out, and bricks() counts their edited
// bricks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_set>
#include <utility>

#include "shared/base/check.h"
#include "shared/field/coord.h"

namespace scree {

class ChunkResidence {
 public:
  using Chunks = std::unordered_set<ChunkCoord, CoordHash>;

  /// From now on the field pages. `bring_in`: puts a chunk that is out back into the field; not null.
  void page_by(std::function<void(ChunkCoord)> bring_in) { bring_in_ = std::move(bring_in); }
  bool pages() const { return bring_in_ != nullptr; }

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
  /// Brings in a chunk that somebody waits for, who may only read the field.
  void bring_in(ChunkCoord chunk) const { bring_in_(chunk); }
  void count_wait() { ++waits_; }

  const Chunks& chunks() const { return chunks_; }
  size_t bricks() const { return bricks_; }
  /// Times that somebody waited for a chunk.
  uint64_t waits() const { return waits_; }
  /// A turn is a tick: by turns it is known which chunks nobody asked for lately.
  uint64_t turn() const { return turn_; }
  void begin_turn() { ++turn_; }

 private:
  std::function<void(ChunkCoord)> bring_in_;  ///< null: all chunks are in
  Chunks chunks_;
  size_t bricks_ = 0;
  uint64_t turn_ = 0;
  uint64_t waits_ = 0;
};

}  // namespace scree
