// Integer coordinates of voxels, bricks and chunks. Distinct types: mixing them up does not compile.
// A voxel (x, y, z) is a sample at position (x, y, z) · voxel size. y is up.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "shared/base/check.h"

namespace scree {

inline constexpr int brick_size = 8;                          ///< voxels a side; an OpenVDB leaf
inline constexpr int chunk_bricks = 4;                        ///< bricks a side
inline constexpr int chunk_size = brick_size * chunk_bricks;  ///< voxels a side

template <typename Tag>
struct Coord {
  int32_t x = 0;
  int32_t y = 0;
  int32_t z = 0;

  auto operator<=>(const Coord&) const = default;
  Coord operator+(const Coord& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Coord operator-(const Coord& o) const { return {x - o.x, y - o.y, z - o.z}; }
};

using VoxelCoord = Coord<struct VoxelTag>;
using BrickCoord = Coord<struct BrickTag>;
using ChunkCoord = Coord<struct ChunkTag>;

/// Largest integer not above x, which must fit an int. Without libm, so the same everywhere.
inline int floor_to_int(float x) {
  CHECK_DEBUG(x >= -2147483648.0F && x < 2147483648.0F);
  const int i = static_cast<int>(x);
  return x < static_cast<float>(i) ? i - 1 : i;
}

/// Arithmetic shift is floor division, also of negatives (C++20).
inline BrickCoord brick_of(VoxelCoord v) {
  return {v.x >> 3, v.y >> 3, v.z >> 3};
}
inline ChunkCoord chunk_of(BrickCoord b) {
  return {b.x >> 2, b.y >> 2, b.z >> 2};
}
inline ChunkCoord chunk_of(VoxelCoord v) {
  return {v.x >> 5, v.y >> 5, v.z >> 5};
}
inline VoxelCoord first_voxel(BrickCoord b) {
  return {b.x * brick_size, b.y * brick_size, b.z * brick_size};
}
inline VoxelCoord first_voxel(ChunkCoord c) {
  return {c.x * chunk_size, c.y * chunk_size, c.z * chunk_size};
}
inline BrickCoord first_brick(ChunkCoord c) {
  return {c.x * chunk_bricks, c.y * chunk_bricks, c.z * chunk_bricks};
}
/// Index of a brick within its chunk, 0..63, z fastest.
inline int index_in_chunk(BrickCoord b) {
  return ((b.x & 3) << 4) | ((b.y & 3) << 2) | (b.z & 3);
}
inline BrickCoord brick_in_chunk(ChunkCoord c, int index) {
  CHECK_DEBUG(index >= 0 && index < chunk_bricks * chunk_bricks * chunk_bricks);
  return {c.x * chunk_bricks + (index >> 4), c.y * chunk_bricks + ((index >> 2) & 3),
          c.z * chunk_bricks + (index & 3)};
}

/// 64 bits that depend on nothing but the coordinates, on any platform: kernels and hashes of fields use
/// them.
template <typename Tag>
uint64_t mixed_bits(const Coord<Tag>& c) {
  uint64_t h = static_cast<uint32_t>(c.x) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ (h >> 29U) ^ static_cast<uint32_t>(c.y)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 32U) ^ static_cast<uint32_t>(c.z)) * 0x94D049BB133111EBULL;
  return h ^ (h >> 31U);
}

/// For unordered containers alone: as wide as size_t, so not the same on every platform.
struct CoordHash {
  template <typename Tag>
  size_t operator()(const Coord<Tag>& c) const {
    return static_cast<size_t>(mixed_bits(c));
  }
};

/// A half-open box of voxels: lo inside, hi outside.
struct VoxelBox {
  VoxelCoord lo;
  VoxelCoord hi;

  bool operator==(const VoxelBox&) const = default;
  VoxelCoord size() const { return hi - lo; }
  bool holds(VoxelCoord v) const {
    return v.x >= lo.x && v.y >= lo.y && v.z >= lo.z && v.x < hi.x && v.y < hi.y && v.z < hi.z;
  }
  /// Whether all of another box, which may be empty, lies in this one.
  bool covers(const VoxelBox& o) const {
    return o.lo.x >= lo.x && o.lo.y >= lo.y && o.lo.z >= lo.z && o.hi.x <= hi.x && o.hi.y <= hi.y &&
           o.hi.z <= hi.z;
  }
  bool empty() const { return hi.x <= lo.x || hi.y <= lo.y || hi.z <= lo.z; }
  VoxelBox grown(int by) const {
    return {{lo.x - by, lo.y - by, lo.z - by}, {hi.x + by, hi.y + by, hi.z + by}};
  }
};

/// The intersection of two boxes; its sides may be negative where they do not meet.
inline VoxelBox common(const VoxelBox& a, const VoxelBox& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

/// The smallest box that holds both.
inline VoxelBox hull_of(const VoxelBox& a, const VoxelBox& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

/// Calls f(ChunkCoord) for each chunk that the box touches, x slowest.
template <typename F>
void for_each_chunk(const VoxelBox& box, F&& f) {
  if (box.empty()) return;
  const ChunkCoord a = chunk_of(box.lo);
  const ChunkCoord b = chunk_of(box.hi - VoxelCoord{1, 1, 1});
  for (int x = a.x; x <= b.x; ++x)
    for (int y = a.y; y <= b.y; ++y)
      for (int z = a.z; z <= b.z; ++z) f(ChunkCoord{x, y, z});
}

/// Calls f(BrickCoord) for each brick that the box touches, x slowest.
template <typename F>
void for_each_brick(const VoxelBox& box, F&& f) {
  if (box.empty()) return;
  const BrickCoord a = brick_of(box.lo);
  const BrickCoord b = brick_of(box.hi - VoxelCoord{1, 1, 1});
  for (int x = a.x; x <= b.x; ++x)
    for (int y = a.y; y <= b.y; ++y)
      for (int z = a.z; z <= b.z; ++z) f(BrickCoord{x, y, z});
}

}  // namespace scree
