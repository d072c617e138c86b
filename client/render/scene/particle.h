// What is in the air for a moment and is no piece: puffs of dust, grains, splinters. No GL. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace scree {

/// As it lies in the GPU's memory (particle_drawer.h).
struct Particle {
  glm::vec3 place_m{0.0F};
  float radius_m = 0.0F;
  std::array<uint8_t, 4> colour{};  ///< linear red, green, blue, and opacity
  float turn = 0.0F;                ///< radians, in the picture; of a puff, also which one it is
  float slender = 0.0F;             ///< of a chip: width to length, 0..1; of a puff: 0
};

}  // namespace scree
