#include "server/provenance/region_zones.h"

#include <algorithm>
#include <iterator>

namespace scree {

RegionZones::RegionZones(const std::vector<Region>& regions, float voxel_size_m)
    : voxel_size_m_(voxel_size_m) {
  std::ranges::copy_if(regions, std::back_inserter(counting_), &Region::counts);
}

glm::vec3 RegionZones::place_of(VoxelCoord voxel) const {
  return glm::vec3(static_cast<float>(voxel.x), static_cast<float>(voxel.y), static_cast<float>(voxel.z)) *
         voxel_size_m_;
}

bool RegionZones::meet(const VoxelBox& box) const {
  if (box.empty()) return false;
  const glm::vec3 lo_m = place_of(box.lo), hi_m = place_of(box.hi);
  return std::ranges::any_of(counting_, [&](const Region& region) { return meets(region, lo_m, hi_m); });
}

bool RegionZones::counts(RegionId region) const {
  return std::ranges::find(counting_, region, &Region::id) != counting_.end();
}

BrickZones RegionZones::of(BrickCoord brick) const {
  const VoxelCoord first = first_voxel(brick);
  const glm::vec3 lo_m = place_of(first),
                  hi_m = place_of(first + VoxelCoord{brick_size, brick_size, brick_size});
  std::vector<const Region*> near;
  for (const Region& region : counting_)
    if (meets(region, lo_m, hi_m)) near.push_back(&region);
  if (near.empty()) return std::nullopt;
  const auto zone_of = [&](VoxelCoord voxel) {
    const auto found =
        std::ranges::find_if(near, [&](const Region* region) { return holds(*region, place_of(voxel)); });
    return found == near.end() ? RegionId{0} : (*found)->id;
  };
  std::array<RegionId, brick_voxels> zones{};
  size_t index = 0;
  for (int x = 0; x < brick_size; ++x)
    for (int y = 0; y < brick_size; ++y)
      for (int z = 0; z < brick_size; ++z) zones[index++] = zone_of(first + VoxelCoord{x, y, z});
  return zones;
}

}  // namespace scree
