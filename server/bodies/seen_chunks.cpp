#include "server/bodies/seen_chunks.h"

#include <algorithm>
#include <vector>

#include "server/bodies/limits.h"
#include "shared/field/terrain.h"

namespace scree {

namespace {

/// Chunk of a height, along y.
int chunk_at(float y_m, float voxel_size_m) {
  return floor_to_int(y_m / voxel_size_m / static_cast<float>(chunk_size));
}

}  // namespace

SeenChunks::SeenChunks(const Field& field)
    : voxel_size_m_(field.source().voxel_size_m),
      lowest_(chunk_at(floor_m(field.source()), voxel_size_m_) - 1),
      highest_(chunk_at(top_m(field.source()), voxel_size_m_) + 1) {}

template <typename F>
void SeenChunks::for_chunks(const VoxelBox& box, F&& f) const {
  const ChunkCoord lo = chunk_of(box.lo), hi = chunk_of(box.hi);
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = std::max(lo.y, lowest_); y <= std::min(hi.y, highest_); ++y)
      for (int z = lo.z; z <= hi.z; ++z) f(ChunkCoord{x, y, z});
}

void SeenChunks::begin_step() {
  left_ = limits::new_chunks_a_step;
  if (seen_.size() > limits::seen_chunks_max) seen_.clear();
}

bool SeenChunks::enter(const VoxelBox& box) {
  std::vector<ChunkCoord> fresh;
  for_chunks(box, [&](ChunkCoord chunk) {
    if (!seen_.contains(chunk)) fresh.push_back(chunk);
  });
  // What takes more than a step has goes on when it is the first.
  if (fresh.size() > left_ && left_ < limits::new_chunks_a_step) return false;
  left_ -= std::min(left_, fresh.size());
  seen_.insert(fresh.begin(), fresh.end());
  return true;
}

void SeenChunks::note(const VoxelBox& box) {
  for_chunks(box, [&](ChunkCoord chunk) { seen_.insert(chunk); });
}

}  // namespace scree
