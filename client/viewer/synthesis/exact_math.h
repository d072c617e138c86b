// Powers and sines of + − × ÷ and √ alone, so that every compiler makes the same bits of them: libraries of
// mathematics differ in the last ones. Relative error below 2e-6, of sines absolute. emscripten's library has
// no std::bit_cast yet.
#pragma once

#include <cstdint>

namespace scree {

/// For x from −120 to 120.
constexpr float exact_exp2(float x) {
  const auto whole = static_cast<int32_t>(x < 0.0F ? x - 1.0F : x);
  const float part = x - static_cast<float>(whole);
  // Taylor's series of e^(part ln 2), part from 0 to 1.
  const float y = 0.693147181F * part;
  const float series =
      1.0F +
      y * (1.0F +
           y / 2.0F *
               (1.0F +
                y / 3.0F * (1.0F + y / 4.0F * (1.0F + y / 5.0F * (1.0F + y / 6.0F * (1.0F + y / 7.0F))))));
  return series * __builtin_bit_cast(float, static_cast<uint32_t>(whole + 127) << 23U);
}

/// For normal numbers above 0.
constexpr float exact_log2(float x) {
  const auto bits = __builtin_bit_cast(uint32_t, x);
  auto whole = static_cast<int32_t>(bits >> 23U) - 127;
  float part = __builtin_bit_cast(float, (bits & 0x7FFFFFU) | 0x3F800000U);
  if (part > 1.41421356F) {
    part *= 0.5F;
    ++whole;
  }
  // The series of the area tangent, part from 0.7 to 1.4.
  const float z = (part - 1.0F) / (part + 1.0F), square = z * z;
  const float series =
      z * (1.0F + square * (1.0F / 3.0F + square * (0.2F + square * (1.0F / 7.0F + square / 9.0F))));
  return static_cast<float>(whole) + 2.88539008F * series;
}

/// For a base above 0.
constexpr float exact_power(float base, float exponent) {
  return exact_exp2(exact_log2(base) * exponent);
}

/// e^x, for x from −80 to 80.
constexpr float exact_exp(float x) {
  return exact_exp2(1.44269504F * x);
}

/// The sine of so many whole turns, from −4 to 4.
constexpr float exact_sine(float turns) {
  float part = turns + 4.0F;
  part -= static_cast<float>(static_cast<int32_t>(part));  // 0 to 1
  if (part > 0.75F)
    part -= 1.0F;
  else if (part > 0.25F)
    part = 0.5F - part;
  const float x = 6.28318531F * part, square = x * x;  // within a quarter of a turn
  return x * (1.0F -
              square / 6.0F *
                  (1.0F - square / 20.0F *
                              (1.0F - square / 42.0F * (1.0F - square / 72.0F * (1.0F - square / 110.0F)))));
}

constexpr float exact_cosine(float turns) {
  return exact_sine(turns + 0.25F);
}

}  // namespace scree
