#include "shared/field/brick_materials.h"

#include <algorithm>
#include <bit>

namespace scree {

namespace {

/// Bits of an index into a list of so many.
unsigned bits_for(size_t values) {
  if (values <= 2) return 1;
  if (values <= 4) return 2;
  return values <= 16 ? 4 : 8;
}

}  // namespace

BrickMaterials::BrickMaterials(const VoxelMaterials& voxels) : all_(voxels.front()) {
  if (std::ranges::all_of(voxels, [this](VoxelMaterial voxel) { return voxel == all_; })) return;
  all_ = ground_own;
  std::array<bool, 256> occurs{};
  for (const VoxelMaterial voxel : voxels) occurs[voxel] = true;
  Plane plane;
  std::array<uint8_t, 256> index{};
  for (size_t value = 0; value < occurs.size(); ++value) {
    if (!occurs[value]) continue;
    index[value] = static_cast<uint8_t>(plane.list.size());
    plane.list.push_back(static_cast<VoxelMaterial>(value));
  }
  const unsigned bits = bits_for(plane.list.size()), each = 8 / bits;
  plane.packed.resize(voxels.size() / each);
  for (size_t i = 0; i < voxels.size(); ++i) {
    uint8_t& byte = plane.packed[i / each];
    byte = static_cast<uint8_t>(byte | index[voxels[i]] << (i % each * bits));
  }
  plane_ = std::make_shared<const Plane>(std::move(plane));
}

VoxelMaterial BrickMaterials::at(int index) const {
  CHECK_DEBUG(index >= 0 && index < brick_voxels);
  if (plane_ == nullptr) return all_;
  const unsigned bits = bits_for(plane_->list.size()), each = 8 / bits;
  const auto i = static_cast<size_t>(index);
  const unsigned mask = (1U << bits) - 1;
  return plane_->list[static_cast<unsigned>(plane_->packed[i / each] >> (i % each * bits)) & mask];
}

void BrickMaterials::unpack(VoxelMaterials& to) const {
  if (plane_ == nullptr) {
    to.fill(all_);
    return;
  }
  const unsigned bits = bits_for(plane_->list.size()), mask = (1U << bits) - 1;
  size_t at = 0;
  for (const uint8_t byte : plane_->packed)
    for (unsigned from = 0; from < 8; from += bits)
      to[at++] = plane_->list[static_cast<unsigned>(byte >> from) & mask];
  CHECK_DEBUG(at == to.size());
}

VoxelMaterials BrickMaterials::unpacked() const {
  VoxelMaterials voxels;
  unpack(voxels);
  return voxels;
}

std::vector<VoxelMaterial> BrickMaterials::list() const {
  return plane_ == nullptr ? std::vector<VoxelMaterial>{all_} : plane_->list;
}

size_t BrickMaterials::bytes() const {
  return plane_ == nullptr ? 0 : sizeof(Plane) + plane_->list.size() + plane_->packed.size();
}

bool BrickMaterials::operator==(const BrickMaterials& other) const {
  if (plane_ == other.plane_) return all_ == other.all_;
  return plane_ != nullptr && other.plane_ != nullptr && *plane_ == *other.plane_;
}

uint64_t brick_hash(BrickCoord coord, const Brick& brick, const BrickMaterials& materials) {
  if (materials.is_ground()) return brick_hash(coord, brick);
  if (materials.is_uniform())
    return painted_brick_hash(coord, brick, static_cast<uint8_t>(material_of(materials.uniform())));
  return mixed_brick_hash(coord, brick, materials.unpacked().data());
}

}  // namespace scree
