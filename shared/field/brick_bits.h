// A set of the 512 voxels of a brick, and floods inside one brick, 64 voxels at a time.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "shared/field/brick.h"

namespace scree {

/// Bit y·8 + z of word x is voxel (x, y, z) of the brick.
struct BrickBits {
  std::array<uint64_t, brick_size> words{};

  bool operator==(const BrickBits&) const = default;
  bool any() const {
    uint64_t all = 0;
    for (const uint64_t word : words) all |= word;
    return all != 0;
  }
  /// `at`: relative to the brick's first voxel.
  bool has(VoxelCoord at) const {
    return ((words[static_cast<size_t>(at.x)] >> (at.y * brick_size + at.z)) & 1U) != 0;
  }
  int count() const {
    int sum = 0;
    for (const uint64_t word : words) sum += std::popcount(word);
    return sum;
  }
  BrickBits operator&(const BrickBits& o) const {
    BrickBits both;
    for (size_t i = 0; i < words.size(); ++i) both.words[i] = words[i] & o.words[i];
    return both;
  }
  BrickBits operator|(const BrickBits& o) const {
    BrickBits either;
    for (size_t i = 0; i < words.size(); ++i) either.words[i] = words[i] | o.words[i];
    return either;
  }
  BrickBits operator~() const {
    BrickBits others;
    for (size_t i = 0; i < words.size(); ++i) others.words[i] = ~words[i];
    return others;
  }
};

/// The six ways out of a brick: +x, −x, +y, −y, +z, −z.
inline constexpr std::array<BrickCoord, 6> brick_faces = {
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// The voxels of the neighbouring brick beyond a face (an index of brick_faces) that touch one of `bits`.
BrickBits across(const BrickBits& bits, size_t face);

/// Voxels of code < 0.
BrickBits solid_bits(const Brick& brick);

/// The voxels of `solid` that connect to `from` inside the brick, by faces of voxels.
BrickBits flooded(const BrickBits& from, const BrickBits& solid);

/// The lowest bit alone; `bits` must not be empty.
BrickBits first_of(const BrickBits& bits);

/// Smallest box that holds the bits, relative to the brick's first voxel; `bits` must not be empty.
VoxelBox bounds_of(const BrickBits& bits);

}  // namespace scree
