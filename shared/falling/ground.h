// Ground, for the searches that ask which terrain is held up: a chunk is ground when it was never edited and
// lies below the terrain's floor, where generated terrain is only rock (floor_m).
#pragma once

#include "shared/field/field.h"

namespace scree {

class Ground {
 public:
  /// `field` must outlive this.
  explicit Ground(const Field& field)
      : field_(field),
        top_chunk_y_(floor_to_int(floor_m(field.source()) /
                                  (static_cast<float>(chunk_size) * field.source().voxel_size_m)) -
                     1) {}

  bool holds(BrickCoord brick) const {
    const ChunkCoord chunk = chunk_of(brick);
    return chunk.y <= top_chunk_y_ && !field_.has_edits(chunk);
  }

 private:
  const Field& field_;
  int top_chunk_y_;  ///< chunks up to this y lie below the floor
};

}  // namespace scree
