#include <algorithm>
#include <cmath>

#include "shared/base/check.h"
#include "shared/field/piece.h"

namespace scree {

namespace {

constexpr float component_max = 0.70710678F;  ///< of the three smallest
constexpr int component_steps = 1023;
constexpr float position_max_m = 1048576.0F;  ///< its steps are near the largest int32_t

int32_t quantise_length(float metres) {
  CHECK_DEBUG(std::abs(metres) <= position_max_m);
  const float steps = metres * pose_steps_per_m;
  return static_cast<int32_t>(steps + (steps < 0.0F ? -0.5F : 0.5F));
}

}  // namespace

QuantisedPose quantise(const Pose& pose) {
  const float c[4] = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
  uint32_t largest = 0;
  for (uint32_t i = 1; i < 4; ++i)
    if (std::abs(c[i]) > std::abs(c[largest])) largest = i;
  CHECK_DEBUG(std::abs(c[largest]) >= 0.49F && std::abs(c[largest]) <= 1.01F);  // of a unit quaternion
  const float sign = c[largest] < 0.0F ? -1.0F : 1.0F;
  uint32_t bits = largest;
  for (uint32_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const float unit = (c[i] * sign / component_max + 1.0F) * 0.5F;
    const int step = static_cast<int>(unit * component_steps + 0.5F);
    bits = (bits << 10U) | static_cast<uint32_t>(std::clamp(step, 0, component_steps));
  }
  return {quantise_length(pose.position_m.x), quantise_length(pose.position_m.y),
          quantise_length(pose.position_m.z), bits};
}

Pose dequantise(const QuantisedPose& pose) {
  const uint32_t largest = pose.rotation >> 30U;
  float c[4] = {};
  float sum = 0.0F;
  uint32_t low_bit = 20;
  for (uint32_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const auto step = static_cast<float>((pose.rotation >> low_bit) & 1023U);
    low_bit -= 10;
    c[i] = (step / static_cast<float>(component_steps) * 2.0F - 1.0F) * component_max;
    sum += c[i] * c[i];
  }
  c[largest] = std::sqrt(std::max(0.0F, 1.0F - sum));
  const float length = std::sqrt(sum + c[largest] * c[largest]);
  CHECK_DEBUG(length > 0.99F);
  Pose out;
  out.position_m = {static_cast<float>(pose.x) / pose_steps_per_m,
                    static_cast<float>(pose.y) / pose_steps_per_m,
                    static_cast<float>(pose.z) / pose_steps_per_m};
  out.rotation = glm::quat(c[3] / length, c[0] / length, c[1] / length, c[2] / length);
  return out;
}

}  // namespace scree
