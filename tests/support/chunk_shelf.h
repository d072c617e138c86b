// A place for chunks that are out of a field's memory: what a world's file is to a server.
#pragma once

#include <map>
#include <vector>

#include "shared/field/field.h"

namespace scree {

class ChunkShelf {
 public:
  ReadChunk reader() {
    return [this](ChunkCoord chunk) -> Result<std::vector<BrickPatch>> {
      ++reads;
      const auto found = chunks.find(chunk);
      if (found == chunks.end()) return fail("the shelf lacks the chunk");
      return found->second;
    };
  }
  /// The chunk's bricks as they are, which it keeps as well.
  void copy(Field& field, ChunkCoord chunk) {
    std::vector<BrickPatch>& bricks = chunks[chunk];
    bricks.clear();
    for (const BrickCoord brick : field.edited_bricks(chunk))
      bricks.push_back({brick, field.brick(brick), field.painted(brick)});
  }
  /// All chunks go out.
  void page_out_all(Field& field) {
    const std::vector<ChunkCoord> in(field.chunks_in().begin(), field.chunks_in().end());
    for (const ChunkCoord chunk : in) {
      copy(field, chunk);
      field.page_out(chunk);
    }
  }

  std::map<ChunkCoord, std::vector<BrickPatch>> chunks;
  size_t reads = 0;
};

}  // namespace scree
