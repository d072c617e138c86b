#include "shared/field/stored_chunks.h"

#include <string>

#include "shared/base/limits.h"

namespace scree {

namespace {

/// Levels at least: from the coarsest, small things can no longer be seen.
constexpr int levels_min = 7;

/// Whether the two chunks around the origin are all that a level has along an axis.
bool is_pair(int lo, int hi, int level) {
  return (lo >> level) >= -1 && ((hi - 1) >> level) <= 0;
}

}  // namespace

int BrickLayout::levels() const {
  int levels = levels_min;
  const auto fits = [&](int level) {
    return is_pair(lo.x, hi.x, level) && is_pair(lo.y, hi.y, level) && is_pair(lo.z, hi.z, level);
  };
  while (!fits(levels - 1)) ++levels;
  return levels;
}

bool BrickLayout::holds(TileKey key) const {
  if (key.kind != TileKind::bricks) return false;
  const int count = levels();
  if (key == root()) return true;
  if (key.level < 0 || key.level >= count) return false;
  const auto within = [&](int at, int first, int end) {
    return at >= (first >> key.level) && at <= ((end - 1) >> key.level);
  };
  return within(key.x, lo.x, hi.x) && within(key.y, lo.y, hi.y) && within(key.z, lo.z, hi.z);
}

std::array<TileKey, 8> BrickLayout::children(TileKey key) const {
  const bool is_root = key == root();
  const auto below = [&](int at, int side) { return is_root ? side - 1 : at * 2 + side; };
  std::array<TileKey, 8> children;
  for (int i = 0; i < 8; ++i)
    children[static_cast<size_t>(i)] =
        key_of(key.level - 1, {below(key.x, i >> 2), below(key.y, (i >> 1) & 1), below(key.z, i & 1)});
  return children;
}

TileKey BrickLayout::parent(TileKey key) const {
  if (key.level + 1 >= levels()) return root();
  return key_of(key.level + 1, {key.x >> 1, key.y >> 1, key.z >> 1});
}

Result<void> validate(const BrickLayout& layout) {
  if (!(layout.voxel_size_m >= limits::voxel_size_min_m && layout.voxel_size_m <= limits::voxel_size_max_m))
    return fail("voxels of the stored bricks must be " + std::to_string(limits::voxel_size_min_m) + " to " +
                std::to_string(limits::voxel_size_max_m) +
                " m wide (limits.voxel_size_min_m, voxel_size_max_m)");
  const float chunk_m = layout.voxel_size_m * static_cast<float>(chunk_size);
  const auto within = [&](int lo, int hi, float half_m) {
    const int most = static_cast<int>(half_m / chunk_m) + 1;
    return lo < hi && lo >= -most && hi <= most;
  };
  if (!within(layout.lo.x, layout.hi.x, limits::world_half_width_m) ||
      !within(layout.lo.y, layout.hi.y, limits::world_half_height_m) ||
      !within(layout.lo.z, layout.hi.z, limits::world_half_width_m))
    return fail("the stored bricks reach beyond the world, which is " +
                std::to_string(static_cast<int>(2.0F * limits::world_half_width_m)) + " m wide and " +
                std::to_string(static_cast<int>(2.0F * limits::world_half_height_m)) +
                " m high (limits.world_half_width_m, world_half_height_m)");
  return {};
}

std::optional<TileKey> stored_key(const GroundModel& model, ChunkCoord chunk, float voxel_size_m) {
  if (!model.bricks()) return std::nullopt;
  const BrickLayout& layout = *model.bricks();
  float spacing_m = layout.voxel_size_m;
  for (int level = 0; level < layout.levels(); ++level, spacing_m *= 2.0F) {
    if (spacing_m != voxel_size_m) continue;
    const TileKey key = key_of(level, chunk);
    return layout.holds(key) ? std::optional(key) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<TileKey> stored_tile_of(const GroundModel& model, ChunkCoord chunk, float voxel_size_m) {
  std::optional<TileKey> key = stored_key(model, chunk, voxel_size_m);
  if (key)
    while (*key != model.bricks()->root() && !model.has(*key)) key = model.bricks()->parent(*key);
  return key;
}

}  // namespace scree
