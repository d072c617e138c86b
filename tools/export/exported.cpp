#include "tools/export/exported.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>

#include "tools/export/limits.h"

namespace scree {

namespace {

/// Rock below the lowest ground that is exported with an elevation model.
constexpr float below_m = 8.0F;

ChunkCoord chunk_at(glm::vec3 p_m, float voxel_size_m) {
  const glm::vec3 p = p_m / voxel_size_m;
  return chunk_of(VoxelCoord{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)});
}

ChunkBox around_both(const ChunkBox& a, const ChunkBox& b) {
  const VoxelBox hull = hull_of(a.voxels(), b.voxels());
  return {chunk_of(hull.lo), chunk_of(hull.hi)};
}

}  // namespace

size_t ChunkBox::count() const {
  const ChunkCoord size = hi - lo;
  return static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z);
}

/// What ends at a chunk's border does not touch the next one.
ChunkBox chunks_of(glm::vec3 lo_m, glm::vec3 hi_m, float voxel_size_m) {
  const auto last = [&](float m) { return static_cast<int>(std::ceil(m / voxel_size_m)) - 1; };
  const ChunkCoord lowest = chunk_at(lo_m, voxel_size_m),
                   highest = chunk_of(VoxelCoord{last(hi_m.x), last(hi_m.y), last(hi_m.z)});
  return {lowest,
          {std::max(lowest.x, highest.x) + 1, std::max(lowest.y, highest.y) + 1,
           std::max(lowest.z, highest.z) + 1}};
}

Result<void> check_count(const ChunkBox& box) {
  if (box.count() <= limits::export_chunks_max) return {};
  return fail(fmt::format("more than {} chunks (limits.export_chunks_max): --box makes them fewer",
                          limits::export_chunks_max));
}

Result<ChunkBox> whole_of(const Field& field) {
  const TerrainSource& source = field.source();
  std::optional<ChunkBox> box;
  const auto add = [&](const ChunkBox& more) { box = box ? around_both(*box, more) : more; };
  for (const ChunkCoord chunk : field.edited_chunks()) add({chunk, chunk + ChunkCoord{1, 1, 1}});
  const auto extent = extent_of(source);
  if (extent && source.heights->bricks()) {
    add({source.heights->bricks()->lo, source.heights->bricks()->hi});
  } else if (extent) {
    add(chunks_of({-extent->half_width_m, floor_m(source) - below_m, -extent->half_depth_m},
                  {extent->half_width_m, top_m(source) + 1.0F, extent->half_depth_m}, source.voxel_size_m));
  }
  if (!box) return fail("nothing was edited, and the ground has no end: choose a part of it (--box)");
  return *box;
}

BrickMaterials said_materials(const Field& field, BrickCoord brick) {
  const BrickMaterials painted = field.materials(brick);
  const BrickMaterials stored =
      field.chunk_bricks(chunk_of(brick)).generated.materials(index_in_chunk(brick));
  if (painted.is_ground() || stored.is_ground()) return painted.is_ground() ? stored : painted;
  VoxelMaterials voxels = painted.unpacked();
  for (int i = 0; i < brick_voxels; ++i)
    if (VoxelMaterial& own = voxels[static_cast<size_t>(i)]; own == ground_own) own = stored.at(i);
  return BrickMaterials(voxels);
}

}  // namespace scree
