// Parts of persons' bodies: round, and as long as they are. Metres. No GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace scree {

/// A ball, stretched along each of its own axes, that was cut in two across y and moved apart; as it lies in
/// the GPU's memory (client/render/gl/limb_drawer.h).
struct Limb {
  glm::vec3 middle_m{0.0F};
  float half_m = 0.0F;                         ///< by which each half was moved
  glm::vec4 rotation{0.0F, 0.0F, 0.0F, 1.0F};  ///< quaternion x, y, z, w
  glm::vec3 radius_m{0.1F};
  std::array<uint8_t, 4> colour{255, 255, 255, 255};  ///< square roots of linear light; the last is not read
};

}  // namespace scree
