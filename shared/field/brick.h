// Bricks of codes: how the field is stored, hashed and sent.
//
// A code c is a signed distance of c · 3/127 voxels, negative inside, saturating at ±127 (±3 voxels, the
// narrow band); −128 is no code. Codes are the only state of the field: every edit ends in codes, with the
// same bits on the server and on every client.
#pragma once

#include <array>
#include <cstdint>

#include "shared/base/check.h"
#include "shared/field/coord.h"

namespace scree {

using Code = int8_t;

inline constexpr int brick_voxels = brick_size * brick_size * brick_size;
inline constexpr Code code_air = 127;
inline constexpr Code code_solid = -127;
inline constexpr float band_voxels = 3.0F;
inline constexpr float codes_per_voxel = 127.0F / band_voxels;

/// 8³ codes, index (x·8 + y)·8 + z: the order of an OpenVDB leaf.
struct Brick {
  std::array<Code, brick_voxels> codes;

  bool operator==(const Brick&) const = default;
  static constexpr int index(int x, int y, int z) {
    CHECK_DEBUG(((x | y | z) & ~(brick_size - 1)) == 0);
    return (x << 6) | (y << 3) | z;
  }
};

/// Nearest code of a distance in voxels, which may be infinite; halves round away from zero.
inline Code encode(float distance_voxels) {
  CHECK_DEBUG(distance_voxels == distance_voxels);  // not NaN
  const float scaled = distance_voxels * codes_per_voxel;
  const float clamped = scaled < -127.0F ? -127.0F : (scaled > 127.0F ? 127.0F : scaled);
  return static_cast<Code>(static_cast<int>(clamped + (clamped < 0.0F ? -0.5F : 0.5F)));
}

/// Distance in voxels.
inline float decode(Code code) {
  return static_cast<float>(code) * (band_voxels / 127.0F);
}

/// The shared bricks that hold only air, or only rock.
const Brick& air_brick();
const Brick& solid_brick();

/// air_brick when every code is code_air, solid_brick when every code is code_solid, else nullptr.
const Brick* uniform_equivalent(const Brick& brick);

/// XXH3 of the coordinate and the codes.
uint64_t brick_hash(BrickCoord coord, const Brick& brick);
/// XXH3 of the coordinate, the codes and the number of the material that all of the brick is of.
uint64_t painted_brick_hash(BrickCoord coord, const Brick& brick, uint8_t material);
/// XXH3 of the coordinate, the codes and hash_of_voxels() of what each voxel is of.
uint64_t mixed_brick_hash(BrickCoord coord, const Brick& brick, uint64_t hash_of_voxels);
/// XXH3 of what each voxel is of.
uint64_t hash_of_voxels(const std::array<uint8_t, brick_voxels>& voxels);

}  // namespace scree
