// The chunks that the ways of fast bodies led through lately. Ground that nobody has looked at is generated
// when a body comes there, which takes as long as a hundred bodies. So the ways of one step lead through so
// many new chunks in all. A body that would go on waits at the border. They are no part of a world's kept
// state. Private to this folder.
#pragma once

#include <cstddef>
#include <unordered_set>

#include "shared/field/field.h"

namespace scree {

class SeenChunks {
 public:
  /// `field` must outlive this object.
  explicit SeenChunks(const Field& field);

  void begin_step();
  /// Whether a way may lead through this box of voxels: its chunks are known, or there is room for them, and
  /// they are from now on. Chunks that hold no surface of the ground count as known.
  bool enter(const VoxelBox& box);
  /// The box is known: a body lies there.
  void note(const VoxelBox& box);

 private:
  /// Calls f(chunk) for those of the box in which the ground's surface may lie.
  template <typename F>
  void for_chunks(const VoxelBox& box, F&& f) const;

  float voxel_size_m_;
  int lowest_, highest_;  ///< chunks, along y, in which the ground's surface may lie
  std::unordered_set<ChunkCoord, CoordHash> seen_;
  size_t left_ = 0;
};

}  // namespace scree
