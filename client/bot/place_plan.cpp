#include "client/bot/place_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/operation/store.h"

namespace scree {

MaterialMass PlacePlan::next() {
  const auto most = std::ranges::max_element(carried_, {}, &MaterialMass::mass);
  if (most == carried_.end()) return {};
  const MassUnits part = sum_of(carried_) / std::max(places_, 1U);
  const MaterialMass share{most->material, std::min(most->mass, part)};
  if (places_ > 0) --places_;
  if (share.mass > 0) take_out(carried_, share.material, share.mass);
  return share;
}

float ball_radius_m(MassUnits mass, int fill, float voxel_size_m) {
  constexpr double most_filled = 0.9;
  const double voxels =
      most_filled * static_cast<double>(mass) / units_per_voxel * fill_solid / static_cast<double>(fill);
  return voxel_size_m * static_cast<float>(std::cbrt(voxels * 0.75 / std::numbers::pi));
}

}  // namespace scree
