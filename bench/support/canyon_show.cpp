#include "bench/support/canyon_show.h"

namespace scree {

CarveRequest blow(const Shape& shape, glm::vec3 impact_m, uint32_t seeds, float speed_m_s) {
  CarveRequest carve;
  carve.shape = shape;
  carve.seeds = seeds;
  carve.random_seed = 4;
  carve.impact_m = impact_m;
  carve.blast_speed_m_s = speed_m_s;
  return carve;
}

std::vector<TimedBlow> canyon_show() {
  const auto struck = [](glm::vec3 at_m, float radius_m, uint32_t seeds, float speed_m_s) {
    return blow(sphere(at_m, radius_m), at_m + glm::vec3(2.0F, 0.0F, 0.0F), seeds, speed_m_s);
  };
  return {{36, struck({0.4F, 8.0F, 14.0F}, 3.0F, 110, 5.0F)},
          {75, struck({0.2F, 9.5F, -3.0F}, 3.4F, 130, 6.0F)},
          {114, struck({0.4F, 6.5F, -16.0F}, 3.0F, 110, 5.0F)},
          {186, struck({15.0F, 1.8F, 7.4F}, 2.8F, 24, 4.0F)},
          {200, struck({15.0F, 1.8F, -7.4F}, 2.8F, 24, 4.0F)}};
}

}  // namespace scree
