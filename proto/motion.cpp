#include "proto/motion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int64_t one = motion_one;

int32_t within(int64_t value, int32_t max) {
  return static_cast<int32_t>(std::clamp<int64_t>(value, -int64_t{max}, max));
}

/// Rounded to the nearest, halves away from zero; the divisor is positive.
int64_t divided(int64_t value, int64_t by) {
  return (value + (value < 0 ? -by / 2 : by / 2)) / by;
}

glm::ivec3 plus(glm::ivec3 a, glm::ivec3 b, int32_t max) {
  return {within(int64_t{a.x} + b.x, max), within(int64_t{a.y} + b.y, max), within(int64_t{a.z} + b.z, max)};
}

glm::ivec3 times(glm::ivec3 v, int32_t by, int32_t max) {
  return {within(int64_t{v.x} * by, max), within(int64_t{v.y} * by, max), within(int64_t{v.z} * by, max)};
}

glm::ivec3 sixteenths(glm::ivec3 v, uint8_t count) {
  const auto part = [&](int32_t n) { return static_cast<int32_t>(divided(int64_t{n} * count, 16)); };
  return {part(v.x), part(v.y), part(v.z)};
}

glm::ivec3 slowed(glm::ivec3 speed, int32_t drag) {
  const auto less = [&](int32_t n) { return n - static_cast<int32_t>((int64_t{n} * drag + 32768) >> 16); };
  return {less(speed.x), less(speed.y), less(speed.z)};
}

uint32_t magnitude(int32_t n) {
  return n < 0 ? 0U - static_cast<uint32_t>(n) : static_cast<uint32_t>(n);
}

MotionTrend after(const MotionTrend& trend, glm::ivec3 correction) {
  const uint32_t greatest =
      std::max({magnitude(correction.x), magnitude(correction.y), magnitude(correction.z)});
  const int now = 16 * std::min(static_cast<int>(std::bit_width(greatest)), 4);
  const int heat =
      now > trend.heat ? trend.heat + (now - trend.heat + 1) / 2 : trend.heat - (trend.heat - now + 3) / 4;
  const auto sign = [](int32_t n) { return (n > 0 ? 1 : 0) - (n < 0 ? 1 : 0); };
  const glm::ivec3 signs{sign(correction.x), sign(correction.y), sign(correction.z)};
  // Corrections of like signs say that the velocity lags behind, of opposite ones that it overshoots.
  const int like = signs.x * trend.sign.x + signs.y * trend.sign.y + signs.z * trend.sign.z;
  return {static_cast<uint8_t>(std::min<int>(heat, MotionTrend::heat_max)),
          static_cast<uint8_t>(std::clamp<int>(trend.gain + 2 * like, 1, MotionTrend::gain_max)), signs};
}

glm::ivec4 unit(const std::array<int64_t, 4>& c) {
  const int64_t length = floor_root(c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3]);
  if (length == 0) return {0, 0, 0, motion_one};
  const auto part = [&](int64_t n) { return static_cast<int32_t>(divided(n * one, length)); };
  return {part(c[0]), part(c[1]), part(c[2]), part(c[3])};
}

/// A packed rotation (shared/field/piece.h).
glm::ivec4 unpacked(uint32_t packed) {
  constexpr int64_t component_max = 741455;  // 2^20 / √2
  constexpr int64_t packed_max = 1023;
  std::array<int64_t, 4> c{};
  int64_t rest = one * one;
  uint32_t low_bit = 20;
  for (uint32_t i = 0; i < 4; ++i) {
    if (i == packed >> 30U) continue;
    c.at(i) =
        divided((2 * int64_t{(packed >> low_bit) & packed_max} - packed_max) * component_max, packed_max);
    rest -= c.at(i) * c.at(i);
    low_bit -= 10;
  }
  c.at(packed >> 30U) = floor_root(std::max<int64_t>(rest, 0));
  return unit(c);
}

int32_t in_steps(float metres) {
  const double steps = double{metres} * motion_steps_per_m;
  if (std::isnan(steps)) return 0;
  return static_cast<int32_t>(
      std::clamp<double>(steps + (steps < 0.0 ? -0.5 : 0.5), -motion_position_max, motion_position_max));
}

glm::ivec3 in_steps(glm::vec3 place_m) {
  return {in_steps(place_m.x), in_steps(place_m.y), in_steps(place_m.z)};
}

}  // namespace

int64_t floor_root(int64_t square) {
  CHECK_DEBUG(square >= 0 && square < (int64_t{1} << 50));
  // Exact: below 2^50 the root of a number under a square differs from the square's by more than it is
  // rounded.
  return static_cast<int64_t>(std::sqrt(static_cast<double>(square)));
}

MotionRules motion_rules(uint32_t tick_rate_hz, uint32_t ticks_per_transform) {
  CHECK(tick_rate_hz > 0);
  const int64_t rate = tick_rate_hz, ticks = ticks_per_transform;
  const auto most = [](int64_t value, int64_t max) { return static_cast<int32_t>(std::min(value, max)); };
  const auto coarse = static_cast<int32_t>(std::clamp<int64_t>(60 * ticks / rate, 1, motion_coarse_max));
  return {.fall = most((2571633 * ticks * ticks + rate * rate / 2) / (rate * rate), motion_velocity_max),
          .drag = most(3277 * ticks / rate, 65536),
          .spin_drag = most(13107 * ticks / rate, 65536),
          .position_step = motion_position_step + motion_position_coarser * (coarse - 1),
          .rotation_step = motion_rotation_step + motion_rotation_coarser * (coarse - 1)};
}

int32_t position_step(MotionMode mode, const MotionRules& rules) {
  return mode == MotionMode::rest ? motion_position_step : rules.position_step;
}

int32_t rotation_step(MotionMode mode, const MotionRules& rules) {
  return mode == MotionMode::rest ? motion_rotation_step : rules.rotation_step;
}

Motion predict(const Motion& motion, MotionMode mode, const MotionRules& rules) {
  Motion next = motion;
  next.mode = mode;
  if (mode == MotionMode::rest) return next;
  next.velocity = slowed(motion.velocity, rules.drag);
  if (mode == MotionMode::fall) next.velocity = plus(next.velocity, {0, -rules.fall, 0}, motion_velocity_max);
  const glm::ivec3 way = (next.velocity + 8) >> 4;
  next.position = plus(motion.position, way, motion_position_max);
  next.spin = slowed(motion.spin, rules.spin_drag);
  if (next.spin != glm::ivec3(0)) next.rotation = turned(motion.rotation, next.spin);
  return next;
}

Motion advance(const Motion& motion, const std::optional<Correction>& correction, const MotionRules& rules) {
  const Correction told = correction.value_or(Correction{motion.mode, {}, {}});
  Motion next = predict(motion, told.mode, rules);
  const glm::ivec3 moved = times(told.position, position_step(told.mode, rules), motion_position_max);
  const glm::ivec3 turn = times(told.rotation, rotation_step(told.mode, rules), motion_turn_max);
  next.position = plus(next.position, moved, motion_position_max);
  if (turn != glm::ivec3(0)) next.rotation = turned(next.rotation, turn);
  if (told.mode == MotionMode::rest) {
    next.velocity = next.spin = {};
    next.position_trend = next.rotation_trend = {};
    return next;
  }
  next.position_trend = after(motion.position_trend, told.position);
  next.rotation_trend = after(motion.rotation_trend, told.rotation);
  next.velocity = plus(next.velocity, times(moved, next.position_trend.gain, 2 * motion_velocity_max),
                       motion_velocity_max);
  next.spin = plus(next.spin, sixteenths(turn, next.rotation_trend.gain), motion_spin_max);
  return next;
}

Motion born_at(glm::vec3 centre_m) {
  Motion motion;
  motion.position = in_steps(centre_m);
  return motion;
}

Motion born_of(const Motion& parent, glm::vec3 off_m) {
  Motion motion = parent;
  motion.position = plus(parent.position, in_steps(pose_of(parent).rotation * off_m), motion_position_max);
  motion.mode = MotionMode::fall;
  return motion;
}

Motion resting_at(const QuantisedPose& pose) {
  constexpr auto finer = motion_steps_per_m / static_cast<int32_t>(pose_steps_per_m);
  Motion motion;
  motion.position = times({pose.x, pose.y, pose.z}, finer, motion_position_max);
  motion.rotation = unpacked(pose.rotation);
  motion.mode = MotionMode::rest;
  return motion;
}

Pose pose_of(const Motion& motion) {
  const glm::dvec4 q(motion.rotation);
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const auto part = [&](double n) { return static_cast<float>(n / length); };
  return {glm::vec3(glm::dvec3(motion.position) / double{motion_steps_per_m}),
          glm::quat(part(q.w), part(q.x), part(q.y), part(q.z))};
}

// |rotation| is 2^20 and the tangent at most 4 √3, so the products stay below 2^43, and shifted below 2^25.
glm::ivec4 turned(const glm::ivec4& rotation, glm::ivec3 turn) {
  const glm::i64vec4 q(rotation);
  const glm::i64vec3 t(times(turn, 1, motion_turn_max));
  return unit({(one * q.x + t.x * q.w + t.y * q.z - t.z * q.y) >> 18,
               (one * q.y + t.y * q.w + t.z * q.x - t.x * q.z) >> 18,
               (one * q.z + t.z * q.w + t.x * q.y - t.y * q.x) >> 18,
               (one * q.w - t.x * q.x - t.y * q.y - t.z * q.z) >> 18});
}

glm::ivec3 turn_between(const glm::ivec4& from, const glm::ivec4& to) {
  const glm::i64vec4 a(from), b(to);
  const int64_t cosine = b.w * a.w + b.x * a.x + b.y * a.y + b.z * a.z;
  const int64_t sign = cosine < 0 ? -1 : 1;  // the shorter way
  const int64_t whole = std::max<int64_t>(sign * cosine >> 10, 1);
  const auto tangent = [&](int64_t sine) {
    return within(divided(sign * (sine >> 10) * one, whole), motion_turn_max);
  };
  return {tangent(b.x * a.w - b.w * a.x - b.y * a.z + b.z * a.y),
          tangent(b.y * a.w - b.w * a.y - b.z * a.x + b.x * a.z),
          tangent(b.z * a.w - b.w * a.z - b.x * a.y + b.y * a.x)};
}

}  // namespace scree
