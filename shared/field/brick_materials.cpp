#include "shared/field/brick_materials.h"

#include <algorithm>
#include <cstring>

namespace scree {

namespace {

/// Bits of an index into a list of so many.
unsigned bits_for(size_t values) {
  if (values <= 2) return 1;
  if (values <= 4) return 2;
  return values <= 16 ? 4 : 8;
}

constexpr uint64_t each_byte = 0x0101010101010101U;

/// 1 in each byte that is not 0. (Hacker's Delight, 6-1.)
constexpr uint64_t nonzero_bytes(uint64_t word) {
  constexpr uint64_t low_bits = 0x7F * each_byte;
  return ((((word & low_bits) + low_bits) | word) >> 7U) & each_byte;
}

/// A byte of ones for each bit that is set, the first in the lowest.
constexpr uint64_t bytes_of_bits(uint8_t bits) {
  return nonzero_bytes(bits * each_byte & 0x8040201008040201U) * 0xFFU;
}

bool are_of_two(const VoxelMaterials& voxels, VoxelMaterial one, VoxelMaterial other) {
  bool of_two = true;
  for (const VoxelMaterial voxel : voxels) of_two &= voxel == one || voxel == other;
  return of_two;
}

/// A bit for each voxel, set where it is not `low`, the first in the lowest bits.
void pack_bits(const VoxelMaterials& voxels, VoxelMaterial low, uint8_t* to) {
  for (size_t i = 0; i < voxels.size(); i += 8, ++to) {
    uint64_t eight;
    std::memcpy(&eight, &voxels[i], sizeof(eight));
    *to = static_cast<uint8_t>((nonzero_bytes(eight ^ low * each_byte) * 0x0102040810204080U) >> 56U);
  }
}

}  // namespace

BrickMaterials::BrickMaterials(const VoxelMaterials& voxels) : all_(voxels.front()) {
  const auto other = std::ranges::find_if(voxels, [this](VoxelMaterial voxel) { return voxel != all_; });
  if (other == voxels.end()) return;
  const auto [low, high] = std::minmax(all_, *other);
  all_ = ground_own;
  if (!are_of_two(voxels, low, high)) {
    pack(voxels);
    return;
  }
  count_less_one_ = 1;
  auto plane = std::make_shared<uint8_t[]>(plane_bytes());
  plane[0] = low;
  plane[1] = high;
  pack_bits(voxels, low, plane.get() + 2);
  plane_ = std::move(plane);
}

void BrickMaterials::pack(const VoxelMaterials& voxels) {
  std::array<bool, 256> occurs{};
  for (const VoxelMaterial voxel : voxels) occurs[voxel] = true;
  std::array<uint8_t, 256> index{};
  std::array<VoxelMaterial, 256> list{};
  size_t count = 0;
  for (size_t value = 0; value < occurs.size(); ++value) {
    if (!occurs[value]) continue;
    index[value] = static_cast<uint8_t>(count);
    list[count++] = static_cast<VoxelMaterial>(value);
  }
  count_less_one_ = static_cast<uint8_t>(count - 1);
  const unsigned bits = bits_for(count), each = 8 / bits;
  auto plane = std::make_shared<uint8_t[]>(plane_bytes());
  std::copy_n(list.begin(), count, plane.get());
  uint8_t* to = plane.get() + count;
  for (size_t i = 0; i < voxels.size(); i += each, ++to) {
    unsigned byte = 0;
    for (unsigned k = 0; k < each; ++k) byte |= static_cast<unsigned>(index[voxels[i + k]]) << (k * bits);
    *to = static_cast<uint8_t>(byte);
  }
  plane_ = std::move(plane);
}

size_t BrickMaterials::plane_bytes() const {
  return values() + size_t{brick_voxels} * bits_for(values()) / 8;
}

VoxelMaterial BrickMaterials::at(int index) const {
  CHECK_DEBUG(index >= 0 && index < brick_voxels);
  if (plane_ == nullptr) return all_;
  const unsigned bits = bits_for(values()), each = 8 / bits;
  const auto i = static_cast<unsigned>(index);
  const unsigned mask = (1U << bits) - 1;
  return listed()[static_cast<unsigned>(packed()[i / each] >> (i % each * bits)) & mask];
}

void BrickMaterials::unpack(VoxelMaterials& to) const {
  if (plane_ == nullptr) {
    to.fill(all_);
    return;
  }
  const unsigned bits = bits_for(values()), mask = (1U << bits) - 1;
  const uint8_t* from = packed();
  const VoxelMaterial* list = listed();
  if (bits == 1) {
    const uint64_t low = list[0] * each_byte, flip = static_cast<uint64_t>(list[0] ^ list[1]) * each_byte;
    for (size_t i = 0; i < to.size(); i += 8, ++from) {
      const uint64_t eight = low ^ (flip & bytes_of_bits(*from));
      std::memcpy(&to[i], &eight, sizeof(eight));
    }
    return;
  }
  for (size_t at = 0; at < to.size(); ++from)
    for (unsigned bit = 0; bit < 8; bit += bits) to[at++] = list[static_cast<unsigned>(*from >> bit) & mask];
}

VoxelMaterials BrickMaterials::unpacked() const {
  VoxelMaterials voxels;
  unpack(voxels);
  return voxels;
}

std::vector<VoxelMaterial> BrickMaterials::list() const {
  if (plane_ == nullptr) return {all_};
  return {listed(), listed() + values()};
}

size_t BrickMaterials::bytes() const {
  constexpr size_t control_bytes = 16;
  return plane_ == nullptr ? 0 : control_bytes + plane_bytes();
}

bool BrickMaterials::operator==(const BrickMaterials& other) const {
  if (plane_ == other.plane_) return all_ == other.all_;
  if (plane_ == nullptr || other.plane_ == nullptr || count_less_one_ != other.count_less_one_) return false;
  return std::equal(plane_.get(), plane_.get() + plane_bytes(), other.plane_.get());
}

uint64_t brick_hash(BrickCoord coord, const Brick& brick, const BrickMaterials& materials) {
  if (materials.is_ground()) return brick_hash(coord, brick);
  if (materials.is_uniform())
    return painted_brick_hash(coord, brick, static_cast<uint8_t>(material_of(materials.uniform())));
  return mixed_brick_hash(coord, brick, materials.unpacked().data());
}

}  // namespace scree
