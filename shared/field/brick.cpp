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
  static_assert(sizeof(Brick) == brick_voxels);
  std::array<unsigned char, 12 + brick_voxels> bytes;
  std::memcpy(bytes.data(), &coord.x, 4);
  std::memcpy(bytes.data() + 4, &coord.y, 4);
  std::memcpy(bytes.data() + 8, &coord.z, 4);
  std::memcpy(bytes.data() + 12, brick.codes.data(), brick_voxels);
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace scree
