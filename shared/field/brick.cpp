#include "shared/field/brick.h"

#define XXH_INLINE_ALL
#include <cstring>
#include <xxhash.h>

namespace scree {

namespace {

Brick filled(Code code) {
  Brick brick;
  brick.codes.fill(code);
  return brick;
}

constexpr size_t hashed_bytes = 12 + brick_voxels;

/// The coordinate and the codes, at the beginning of `bytes`.
void lay_out(BrickCoord coord, const Brick& brick, unsigned char* bytes) {
  static_assert(sizeof(Brick) == brick_voxels);
  std::memcpy(bytes, &coord.x, 4);
  std::memcpy(bytes + 4, &coord.y, 4);
  std::memcpy(bytes + 8, &coord.z, 4);
  std::memcpy(bytes + 12, brick.codes.data(), brick_voxels);
}

}  // namespace

const Brick& air_brick() {
  static const Brick brick = filled(code_air);
  return brick;
}

const Brick& solid_brick() {
  static const Brick brick = filled(code_solid);
  return brick;
}

const Brick* uniform_equivalent(const Brick& brick) {
  if (brick == air_brick()) return &air_brick();
  if (brick == solid_brick()) return &solid_brick();
  return nullptr;
}

uint64_t brick_hash(BrickCoord coord, const Brick& brick) {
  std::array<unsigned char, hashed_bytes> bytes;
  lay_out(coord, brick, bytes.data());
  return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t painted_brick_hash(BrickCoord coord, const Brick& brick, uint8_t material) {
  std::array<unsigned char, hashed_bytes + 1> bytes;
  lay_out(coord, brick, bytes.data());
  bytes.back() = material;
  return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t mixed_brick_hash(BrickCoord coord, const Brick& brick, uint64_t hash_of_voxels) {
  std::array<unsigned char, hashed_bytes + sizeof(hash_of_voxels)> bytes;
  lay_out(coord, brick, bytes.data());
  std::memcpy(bytes.data() + hashed_bytes, &hash_of_voxels, sizeof(hash_of_voxels));
  return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t hash_of_voxels(const std::array<uint8_t, brick_voxels>& voxels) {
  return XXH3_64bits(voxels.data(), voxels.size());
}

}  // namespace scree
