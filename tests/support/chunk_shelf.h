// A place for chunks that are out of a field's memory: what a world's file is to a server.
#pragma once

#include <map>
#include <vector>

#include "shared/field/field_paging.h"

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
  void copy(const Field& field, ChunkCoord chunk) {
    std::vector<BrickPatch>& bricks = chunks[chunk];
    bricks.clear();
    for (const BrickCoord brick : field.edited_bricks(chunk))
      bricks.push_back({brick, field.brick(brick), field.materials(brick)});
  }
  /// All chunks go out.
  void page_out_all(FieldPaging paging) {
    const auto& in_memory = paging.field().chunks_in();
    for (const ChunkCoord chunk : std::vector<ChunkCoord>(in_memory.begin(), in_memory.end())) {
      copy(paging.field(), chunk);
      paging.page_out(chunk);
    }
  }

  std::map<ChunkCoord, std::vector<BrickPatch>> chunks;
  size_t reads = 0;
};

}  // namespace scree
