#include "client/render/details/ground_cover.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

namespace scree {
namespace {

/// As client/shaders/noise.glsl.
float lattice_value(int x, int y, int z) {
  uint32_t h = static_cast<uint32_t>(x) * 0x8DA6B343U ^ static_cast<uint32_t>(y) * 0xD8163841U ^
               static_cast<uint32_t>(z) * 0xCB1AB31FU;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h ^= h >> 12U;
  return static_cast<float>(h & 0xFFFFU) / 65535.0F;
}

float smooth_noise(glm::vec3 p) {
  const glm::vec3 base = glm::floor(p), f = p - base, u = f * f * (3.0F - 2.0F * f);
  const auto x = static_cast<int>(base.x), y = static_cast<int>(base.y), z = static_cast<int>(base.z);
  const auto along_x = [&](int dy, int dz) {
    return glm::mix(lattice_value(x, y + dy, z + dz), lattice_value(x + 1, y + dy, z + dz), u.x);
  };
  return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), u.y), glm::mix(along_x(0, 1), along_x(1, 1), u.y),
                  u.z);
}

}  // namespace

GroundCover ground_cover(glm::vec3 place_m, glm::vec3 normal, float ice_above_m) {
  const float coarse = smooth_noise(place_m * 0.16F);
  const float middle = smooth_noise(place_m * 1.3F + 17.0F);
  const float small = smooth_noise(place_m * 5.1F + 5.0F);
  const float fine = 0.6F * middle + 0.4F * small;
  GroundCover cover;
  cover.fine = fine;
  cover.flat = glm::smoothstep(0.72F, 0.90F, normal.y + 0.12F * (fine - 0.5F));
  cover.green = glm::smoothstep(0.42F, 0.66F, coarse + 0.22F * (fine - 0.5F) + 0.006F * place_m.y);
  const float high =
      glm::smoothstep(-0.9F, 1.3F, place_m.y - ice_above_m + 1.6F * (coarse - 0.5F) + 0.5F * (fine - 0.5F));
  cover.snow = high * glm::smoothstep(0.30F, 0.62F, normal.y + 0.20F * (fine - 0.5F));
  return cover;
}

}  // namespace scree
