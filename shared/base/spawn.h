// The place where visitors of a world begin: where their eye is, and which way it looks. Metres and degrees;
// yaw 0 looks along −z and grows to the left, pitch grows upwards, as of a camera.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

struct Spawn {
  glm::vec3 eye_m{0.0F};
  float yaw_degrees = 0.0F;
  float pitch_degrees = 0.0F;

  bool operator==(const Spawn&) const = default;
};

/// As far from the level as a spawn may look: no direction is wrong straight up or down.
inline constexpr float spawn_pitch_max_degrees = 89.0F;

/// "X,Y,Z,YAW,PITCH"; in hundredths of a metre and tenths of a degree, which parse_spawn() reads back.
std::string text_of(const Spawn& spawn);
/// "X,Y,Z" or "X,Y,Z,YAW,PITCH", within the world. The yaw becomes one within ±180.
Result<Spawn> parse_spawn(std::string_view text);

/// The spawn as its text says it.
Spawn rounded(const Spawn& spawn);

}  // namespace scree
