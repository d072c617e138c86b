#include "bench/support/canyon_show.h"

#include "tools/scenes/structures.h"

namespace scree {

std::vector<TimedBlow> canyon_show() {
  const auto struck = [](glm::vec3 at_m, float radius_m, uint32_t seeds, float speed_m_s) {
    return strike(sphere(at_m, radius_m), at_m + glm::vec3(2.0F, 0.0F, 0.0F), seeds, speed_m_s);
  };
  return {{36, struck({0.4F, 7.5F, 13.5F}, 4.5F, 200, 6.0F)},
          {84, struck({0.2F, 8.5F, -2.0F}, 4.0F, 160, 6.0F)},
          {138, struck({15.0F, 7.6F, 0.0F}, 2.7F, 60, 3.0F)},
          {186, struck({15.0F, 1.6F, 7.4F}, 2.8F, 40, 4.0F)},
          {204, struck({15.0F, 1.6F, -7.4F}, 2.8F, 40, 4.0F)},
          {264, struck({0.4F, 6.5F, -17.0F}, 4.2F, 160, 6.0F)}};
}

}  // namespace scree
