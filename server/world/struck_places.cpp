#include "server/world/struck_places.h"

#include <algorithm>

#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

float StruckPlaces::add(VoxelCoord voxel, float energy_j, Tick now) {
  CHECK(energy_j >= 0.0F);
  Suffered& cell = cells_[cell_of_place(voxel)];
  cell.energy_j += energy_j;
  cell.at = now;
  const float sum = cell.energy_j;
  if (cells_.size() > limits::struck_places_max)
    cells_.erase(std::ranges::min_element(cells_, {}, [](const auto& one) { return one.second.at; }));
  return sum;
}

void StruckPlaces::forget(std::span<const BrickCoord> changed) {
  std::erase_if(cells_, [&](const auto& one) {
    return std::ranges::binary_search(changed, brick_of_place(one.first));
  });
}

std::vector<StruckPlace> StruckPlaces::value() const {
  std::vector<StruckPlace> value;
  for (const auto& [cell, suffered] : cells_) value.push_back({cell, suffered.energy_j, suffered.at});
  return value;
}

void StruckPlaces::restore(const std::vector<StruckPlace>& value) {
  cells_.clear();
  for (const StruckPlace& place : value) cells_[place.cell] = {place.energy_j, place.at};
}

}  // namespace scree
