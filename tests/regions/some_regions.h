// Regions for tests.
#pragma once

#include <string>

#include "shared/operation/request.h"

namespace scree {

inline Region region_of(RegionForm form, glm::vec3 centre_m, glm::vec3 half_m, uint8_t forbids = 0,
                        const std::string& name = "tower") {
  Region region;
  region.name = name;
  region.form = form;
  region.centre_m = centre_m;
  region.half_m = half_m;
  region.forbids = forbids;
  return region;
}

inline SetRegionRequest set_box(glm::vec3 centre_m, glm::vec3 half_m, uint8_t forbids,
                                const std::string& name = "tower") {
  return {region_of(RegionForm::box, centre_m, half_m, forbids, name)};
}

inline CarveRequest carve_ball(glm::vec3 at_m, float radius_m, uint32_t seeds = 4, uint32_t random_seed = 1) {
  CarveRequest carve;
  carve.shape = sphere(at_m, radius_m);
  carve.seeds = seeds;
  carve.random_seed = random_seed;
  carve.impact_m = at_m;
  return carve;
}

}  // namespace scree
