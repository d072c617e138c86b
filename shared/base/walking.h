// What a person on foot is asked to do, and how the person stands and moves: plain values. Metres, seconds.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace scree {

namespace limits {
/// How fast a person may be made, as a multiple of the usual speed. Above: refused.
inline constexpr float walk_pace_max = 3.0F;
}  // namespace limits

struct WalkInput {
  glm::vec3 go{0.0F};  ///< direction over the ground, as part of the full speed; its height does not count
  bool fast = false;
  bool jump = false;

  bool operator==(const WalkInput&) const = default;
};

/// The whole state of a walker (shared/person/walker.h): the same state, input and ground give the same bits.
struct WalkerState {
  glm::vec3 feet_m{0.0F};
  glm::vec3 speed_m_s{0.0F};
  float time_left_s = 0.0F;  ///< less than one of the walker's ticks
  bool stands = false;
  int32_t still_ticks = 0;  ///< in which it should have fallen and did not
  float pace = 1.0F;        ///< multiple of the usual walking and running speed

  bool operator==(const WalkerState&) const = default;
};

}  // namespace scree
