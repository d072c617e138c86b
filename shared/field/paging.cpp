#include "shared/field/paging.h"

#include "shared/field/field.h"
#include "shared/field/ground_materials.h"

namespace scree {

Result<PagedChunk> paged_of(const TerrainSource& source, ChunkCoord chunk,
                            std::span<const BrickPatch> bricks) {
  if (bricks.empty()) return fail("a chunk comes without bricks");
  PagedChunk left;
  for (const BrickPatch& patch : bricks) {
    if (chunk_of(patch.coord) != chunk) return fail("a brick lies outside its chunk");
    const uint64_t bit = uint64_t{1} << index_in_chunk(patch.coord);
    if ((left.bricks & bit) != 0) return fail("a brick comes twice");
    left.bricks |= bit;
    left.hash += brick_hash(patch.coord, patch.brick, patch.materials);
    left.mass += brick_mass(source, patch.coord, patch.brick, patch.materials);
  }
  return left;
}

}  // namespace scree
