// Ground, for the searches that ask which terrain is held up. A chunk is ground in two cases. It was never
// edited and lies below the terrain's floor, where unedited terrain is only rock (floor_m). Or it lies below
// the surface of its own column of chunks, and nothing was edited from there down to the floor, so that rock
// holds it up.
#pragma once

#include <map>

#include "shared/field/field.h"

namespace scree {

class Ground {
 public:
  /// `field` must outlive this.
  explicit Ground(const Field& field)
      : field_(field),
        floor_chunk_y_(last_below(floor_m(field.source()))),
        top_chunk_y_(last_below(top_m(field.source())) + 1) {}

  bool holds(BrickCoord brick) const {
    const ChunkCoord chunk = chunk_of(brick);
    if (chunk.y > floor_chunk_y_ && chunk.y > column_top(chunk)) return false;
    for (ChunkCoord below = chunk; below.y > floor_chunk_y_; --below.y)
      if (field_.has_edits(below)) return false;
    return chunk.y > floor_chunk_y_ || !field_.has_edits(chunk);
  }

  /// Whether an unedited chunk may be more than rock alone or air alone, by bounds: if so, its terrain may
  /// have to be generated.
  bool may_hold_surface(ChunkCoord chunk) const {
    return chunk.y <= top_chunk_y_ && chunk.y > floor_chunk_y_ && chunk.y > column_top(chunk);
  }

 private:
  int last_below(float height_m) const {
    return floor_to_int(height_m / (static_cast<float>(chunk_size) * field_.source().voxel_size_m)) - 1;
  }

  /// Chunks of the column up to this y are only rock, unless they were edited.
  int column_top(ChunkCoord chunk) const {
    const auto [found, is_new] = column_tops_.try_emplace({chunk.x, chunk.z}, 0);
    if (is_new) found->second = last_below(floor_m(field_.source(), chunk.x, chunk.z));
    return found->second;
  }

  const Field& field_;
  int floor_chunk_y_;  ///< chunks up to this y lie below the floor
  int top_chunk_y_;    ///< above this y there is only air
  mutable std::map<std::pair<int, int>, int> column_tops_;
};

}  // namespace scree
