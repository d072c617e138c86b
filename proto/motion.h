// How a piece moves, in integers: server and client predict the same next pose from what was sent before, so
// that only the errors of predictions cross the wire (dead reckoning, as in IEEE 1278.1). The arithmetic is
// specified in docs/motions.md.
//
// A step is the time between two frames with poses. The same bits on every machine. Every number is saturated
// at the bounds below, so that nothing overflows whatever a motion holds.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "shared/field/piece.h"

namespace scree {

/// What a prediction takes a piece to do. The value is its number on the wire.
enum class MotionMode : uint8_t {
  rest,   ///< it stays
  slide,  ///< it keeps its velocity and spin
  fall,   ///< gravity, too
};
inline constexpr uint32_t motion_modes = 3;

/// Positions are multiples of 1/16384 m, velocities of a sixteenth of that a step, rotations of 2^-20.
inline constexpr int32_t motion_steps_per_m = 16384;
inline constexpr int32_t motion_one = 1 << 20;

/// Bounds: 131 km, 64 m a step, 90° a step, and 152° of one turn.
inline constexpr int32_t motion_position_max = 0x7FFFFFFF;
inline constexpr int32_t motion_velocity_max = 1 << 24;
inline constexpr int32_t motion_spin_max = 1 << 20;
inline constexpr int32_t motion_turn_max = 1 << 22;

/// Steps of the corrections of a piece that rests or moves for a sixtieth of a second, 1.28 mm and 0.3°: with
/// the rounding of published poses, what they leave is within 2 mm and 0.5° of the body.
inline constexpr int32_t motion_position_step = 21;
inline constexpr int32_t motion_rotation_step = 2700;
/// What each further sixtieth of a second adds to the steps, and the longest time with which they grow, in
/// sixtieths: at 20 Hz 6.8 mm and 1.7°, less than drawing between poses is off.
inline constexpr int32_t motion_position_coarser = 45;
inline constexpr int32_t motion_rotation_coarser = 6450;
inline constexpr int32_t motion_coarse_max = 4;

/// The latest corrections, of which the next ones are like.
struct MotionTrend {
  static constexpr uint8_t heat_max = 63;
  static constexpr uint8_t gain_max = 16;
  uint8_t heat = 0;         ///< how large they were, 0 to heat_max
  uint8_t gain = gain_max;  ///< share that the velocity takes over, in sixteenths: 1 to gain_max
  glm::ivec3 sign{0};       ///< of the last one

  bool operator==(const MotionTrend&) const = default;
};

struct Motion {
  glm::ivec3 position{0};
  glm::ivec3 velocity{0};                    ///< a step
  glm::ivec4 rotation{0, 0, 0, motion_one};  ///< unit quaternion x, y, z, w
  glm::ivec3 spin{0};                        ///< of a step: its axis times the tangent of half its angle
  MotionMode mode = MotionMode::fall;
  MotionTrend position_trend;
  MotionTrend rotation_trend;

  bool operator==(const Motion&) const = default;
};

/// What a step does, by the rates in the welcome.
struct MotionRules {
  int32_t fall = 0;           ///< downward velocity gained
  int32_t drag = 0;           ///< velocity lost, in 1/65536
  int32_t spin_drag = 0;      ///< spin lost, in 1/65536
  int32_t position_step = 0;  ///< of corrections of pieces that move
  int32_t rotation_step = 0;
};
/// The rate is positive.
MotionRules motion_rules(uint32_t tick_rate_hz, uint32_t ticks_per_transform);

/// The error of a prediction in that mode, which the piece has from then on; in the steps below.
struct Correction {
  MotionMode mode = MotionMode::fall;
  glm::ivec3 position{0};
  glm::ivec3 rotation{0};

  bool operator==(const Correction&) const = default;
};

/// The steps of corrections in that mode.
int32_t position_step(MotionMode mode, const MotionRules& rules);
int32_t rotation_step(MotionMode mode, const MotionRules& rules);

/// The motion after a step in that mode, if nothing is corrected.
Motion predict(const Motion& motion, MotionMode mode, const MotionRules& rules);
/// The motion after a step; without a correction, as predicted in its own mode.
Motion advance(const Motion& motion, const std::optional<Correction>& correction, const MotionRules& rules);

/// A piece that was cut out of the terrain, before its first step; metres.
Motion born_at(glm::vec3 centre_m);
/// A fragment of a piece, before its first step. `off_m`: from the parent's centre of mass to its own, in the
/// volume's axes.
Motion born_of(const Motion& parent, glm::vec3 off_m);
Motion resting_at(const QuantisedPose& pose);
Pose pose_of(const Motion& motion);

/// The rotation, then a turn: its axis times the tangent of half its angle, within ± motion_turn_max.
glm::ivec4 turned(const glm::ivec4& rotation, glm::ivec3 turn);
/// The turn that leads from one rotation to the other.
glm::ivec3 turn_between(const glm::ivec4& from, const glm::ivec4& to);

/// The floor of the root; 0 ≤ square < 2^50.
int64_t floor_root(int64_t square);

}  // namespace scree
