#include "shared/field/brick_materials.h"

#include <algorithm>
#include <bit>
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

uint64_t word_at(const uint8_t* eight) {
  uint64_t word;
  std::memcpy(&word, eight, sizeof(word));
  return word;
}

/// Ones in each byte that is the value.
constexpr uint64_t bytes_that_are(uint64_t word, uint8_t value) {
  return ~(nonzero_bytes(word ^ value * each_byte) * 0xFFU);
}

constexpr size_t few_max = 4;

/// The values that occur; as many as count, in order, if they are few.
struct FewValues {
  std::array<VoxelMaterial, few_max> list{};
  size_t count = 0;  ///< more than few_max: more than few

  explicit FewValues(const VoxelMaterials& voxels) {
    for (size_t i = 0; i < voxels.size(); i += 8) {
      for (uint64_t word = word_at(&voxels[i]), others; (others = unlisted(word)) != 0;) {
        if (count == few_max) {
          ++count;
          return;
        }
        list[count++] = voxels[i + static_cast<size_t>(std::countr_zero(others)) / 8];
      }
    }
    std::sort(list.begin(), list.begin() + static_cast<ptrdiff_t>(count));
  }

 private:
  uint64_t unlisted(uint64_t word) const {
    uint64_t listed = 0;
    for (size_t k = 0; k < count; ++k) listed |= bytes_that_are(word, list[k]);
    return ~listed;
  }
};

/// A bit for each voxel, set where it is not `low`, the first in the lowest bits.
void pack_one_bit(const VoxelMaterials& voxels, VoxelMaterial low, uint8_t* to) {
  for (size_t i = 0; i < voxels.size(); i += 8, ++to)
    *to = static_cast<uint8_t>((nonzero_bytes(word_at(&voxels[i]) ^ low * each_byte) * 0x0102040810204080U) >>
                               56U);
}

/// Two bits for each voxel, its place in the list.
void pack_two_bits(const VoxelMaterials& voxels, const FewValues& values, uint8_t* to) {
  for (size_t i = 0; i < voxels.size(); i += 8, to += 2) {
    const uint64_t word = word_at(&voxels[i]);
    uint64_t places = 0;
    for (size_t k = 1; k < values.count; ++k) places |= bytes_that_are(word, values.list[k]) & k * each_byte;
    places = (places | places >> 6U) & 0x000F000F000F000FU;
    places = (places | places >> 12U) & 0x000000FF000000FFU;
    places |= places >> 24U;
    to[0] = static_cast<uint8_t>(places);
    to[1] = static_cast<uint8_t>(places >> 8U);
  }
}

/// The places of eight voxels, a byte each, of two bits each.
constexpr uint64_t spread_two_bits(uint64_t packed) {
  packed = (packed | packed << 24U) & 0x000000FF000000FFU;
  packed = (packed | packed << 12U) & 0x000F000F000F000FU;
  return (packed | packed << 6U) & 3 * each_byte;
}

/// Bytes of a word that are all of one bit of theirs.
constexpr uint64_t bytes_of_bit(uint64_t bytes, unsigned bit) {
  return ((bytes >> bit) & each_byte) * 0xFFU;
}

/// The reverse of pack_two_bits().
void unpack_two_bits(const uint8_t* from, const VoxelMaterial* list, size_t count, VoxelMaterials& to) {
  const auto all_of = [&](size_t k) { return k < count ? list[k] * each_byte : 0; };
  // What each of the two bits changes, and what both together change beside that.
  const uint64_t low = all_of(0), one = low ^ all_of(1), two = low ^ all_of(2);
  const uint64_t both = one ^ two ^ low ^ all_of(3);
  for (size_t i = 0; i < to.size(); i += 8, from += 2) {
    const uint64_t places = spread_two_bits(from[0] | static_cast<uint64_t>(from[1]) << 8U);
    const uint64_t first = bytes_of_bit(places, 0), second = bytes_of_bit(places, 1);
    const uint64_t eight = low ^ (first & one) ^ (second & two) ^ (first & second & both);
    std::memcpy(&to[i], &eight, sizeof(eight));
  }
}

}  // namespace

BrickMaterials::BrickMaterials(const VoxelMaterials& voxels) {
  const FewValues values(voxels);
  if (values.count == 1) {
    all_ = values.list[0];
    return;
  }
  if (values.count > few_max) {
    pack(voxels);
    return;
  }
  count_less_one_ = static_cast<uint8_t>(values.count - 1);
  auto plane = plane_of(voxels);
  uint8_t* const packed = std::copy_n(values.list.begin(), values.count, plane.get() + sizeof(uint64_t));
  if (values.count == 2)
    pack_one_bit(voxels, values.list[0], packed);
  else
    pack_two_bits(voxels, values, packed);
  plane_ = std::move(plane);
}

/// Packs more values than few.
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
  auto plane = plane_of(voxels);
  uint8_t* to = std::copy_n(list.begin(), count, plane.get() + sizeof(uint64_t));
  for (size_t i = 0; i < voxels.size(); i += each, ++to) {
    unsigned byte = 0;
    for (unsigned k = 0; k < each; ++k) byte |= static_cast<unsigned>(index[voxels[i + k]]) << (k * bits);
    *to = static_cast<uint8_t>(byte);
  }
  plane_ = std::move(plane);
}

size_t BrickMaterials::plane_bytes() const {
  return sizeof(uint64_t) + values() + size_t{brick_voxels} * bits_for(values()) / 8;
}

/// A plane for so many values, with its hash and without its content.
std::shared_ptr<uint8_t[]> BrickMaterials::plane_of(const VoxelMaterials& voxels) const {
  auto plane = std::make_shared<uint8_t[]>(plane_bytes());
  const uint64_t hash = hash_of_voxels(voxels);
  std::memcpy(plane.get(), &hash, sizeof(hash));
  return plane;
}

uint64_t BrickMaterials::hash_of_plane() const {
  CHECK_DEBUG(!is_uniform());
  uint64_t hash;
  std::memcpy(&hash, plane_.get(), sizeof(hash));
  return hash;
}

VoxelMaterial BrickMaterials::at(int index) const {
  CHECK_DEBUG(index >= 0 && index < brick_voxels);
  if (plane_ == nullptr) return all_;
  // An index has 2^shift bits; 8 >> shift of them fill a byte.
  const unsigned shift = static_cast<unsigned>(std::countr_zero(bits_for(values())));
  const auto i = static_cast<unsigned>(index);
  const unsigned byte = packed()[i >> (3 - shift)], first_bit = (i << shift) & 7;
  return listed()[byte >> first_bit & ((1U << (1U << shift)) - 1)];
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
  if (bits == 2) {
    unpack_two_bits(from, list, values(), to);
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
  return mixed_brick_hash(coord, brick, materials.hash_of_plane());
}

}  // namespace scree
