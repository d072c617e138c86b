#include "server/world/region_state.h"

#include <algorithm>

#include "server/world/limits.h"
#include "server/world/state_hash.h"
#include "shared/base/check.h"

namespace scree {

namespace {

glm::vec3 middle_m(VoxelCoord v, float voxel_size_m) {
  return glm::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)) * voxel_size_m;
}

/// Whether a region meets the middles of some of these voxels.
bool meets_voxels(const Region& region, const VoxelBox& box, float voxel_size_m) {
  return meets(region, middle_m(box.lo, voxel_size_m), middle_m(box.hi - VoxelCoord{1, 1, 1}, voxel_size_m));
}

bool holds_one(const Region& region, VoxelCoord origin, const BrickBits& bits, float voxel_size_m) {
  for (int x = 0; x < brick_size; ++x)
    for (uint64_t left = bits.words[static_cast<size_t>(x)]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const VoxelCoord at = origin + VoxelCoord{x, bit / brick_size, bit % brick_size};
      if (holds(region, middle_m(at, voxel_size_m))) return true;
    }
  return false;
}

}  // namespace

const RegionHolding::Numbers& RegionHolding::near(ChunkCoord chunk) const {
  if (near_.size() > limits::region_chunks_kept_max) near_.clear();
  const auto [found, is_new] = near_.try_emplace(chunk);
  if (!is_new) return found->second;
  const BrickCoord first{chunk.x * chunk_bricks, chunk.y * chunk_bricks, chunk.z * chunk_bricks};
  const VoxelCoord lo = first_voxel(first);
  const VoxelBox box{lo, lo + VoxelCoord{chunk_size, chunk_size, chunk_size}};
  for (uint32_t number = 0; number < regions_.size(); ++number)
    if (meets_voxels(regions_[number], box, voxel_size_m_)) found->second.push_back(number);
  return found->second;
}

bool RegionHolding::holds(BrickCoord brick, const BrickBits& bits) const {
  const VoxelCoord origin = first_voxel(brick);
  const VoxelBox box{origin, origin + VoxelCoord{brick_size, brick_size, brick_size}};
  for (const uint32_t number : near(chunk_of(brick))) {
    const Region& region = regions_[number];
    if (!meets_voxels(region, box, voxel_size_m_) || !holds_one(region, origin, bits, voxel_size_m_))
      continue;
    noted_.emplace_back(region.id, brick);
    return true;
  }
  return false;
}

const Region* WorldRegions::named(std::string_view name) const {
  const auto found = std::ranges::find(all(), name, &Region::name);
  return found == all().end() ? nullptr : &*found;
}

void WorldRegions::changed(std::vector<Region> regions) {
  hash_ = 0;
  forbidden_ = 0;
  tells_ = false;
  std::vector<Region> holding;
  for (const Region& region : regions) {
    hash_ += hash_of(region);
    forbidden_ |= region.forbids;
    tells_ = tells_ || region.tells;
    if (region.forbids_any(forbids::falls)) holding.push_back(region);
  }
  holding_->set(std::move(holding));
  zones_ = RegionZones(regions, voxel_size_m_);
  all_ = std::make_shared<const std::vector<Region>>(std::move(regions));
}

void WorldRegions::set(Region region) {
  std::vector<Region> regions = all();
  const auto place = std::ranges::lower_bound(regions, region.id, {}, &Region::id);
  if (place != regions.end() && place->id == region.id)
    *place = std::move(region);
  else
    regions.insert(place, std::move(region));
  changed(std::move(regions));
}

void WorldRegions::remove(RegionId id) {
  std::vector<Region> regions = all();
  const size_t removed = std::erase_if(regions, [id](const Region& region) { return region.id == id; });
  CHECK_EQ(removed, 1U);
  changed(std::move(regions));
}

const Region* WorldRegions::forbidding(uint8_t what, const Shape& shape) const {
  if (!forbid_any(what)) return nullptr;
  const auto found = std::ranges::find_if(
      all(), [&](const Region& region) { return region.forbids_any(what) && meets(region, shape); });
  return found == all().end() ? nullptr : &*found;
}

const Region* WorldRegions::forbidding(uint8_t what, glm::vec3 place_m) const {
  return forbidding(what, sphere(place_m, 0.0F));
}

const Region* WorldRegions::forbidding(uint8_t what, const VoxelBox& box) const {
  if (!forbid_any(what)) return nullptr;
  const auto found = std::ranges::find_if(all(), [&](const Region& region) {
    return region.forbids_any(what) && meets_voxels(region, box, voxel_size_m_);
  });
  return found == all().end() ? nullptr : &*found;
}

void WorldRegions::remember(RegionId region, BrickCoord brick) {
  std::set<ChunkCoord>& chunks = hung[region];
  if (chunks.size() < limits::hung_chunks_max) chunks.insert(chunk_of(brick));
}

void WorldRegions::remember_held() {
  for (const auto& [region, brick] : holding_->take_noted()) remember(region, brick);
}

void WorldRegions::remember_held(std::span<const BrickCoord> searched) {
  const auto noted = holding_->take_noted();
  if (noted.empty()) return;
  for (const BrickCoord brick : searched) remember(noted.front().first, brick);
}

}  // namespace scree
