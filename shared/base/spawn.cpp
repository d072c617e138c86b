#include "shared/base/spawn.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "shared/base/limits.h"

namespace scree {

namespace {

/// Fewer than the wire's limit of a setting's value asks for.
constexpr size_t numbers_max = 5;
constexpr size_t numbers_of_place = 3;

/// "'TEXT' WHY"; put together piece by piece, for g++ 12 warns of no overflow then (its bug 105651).
tl::unexpected<Error> refuse_place(std::string_view text, std::string_view why) {
  std::string words = "'";
  words.append(text).append("' ").append(why);
  return fail(std::move(words));
}

tl::unexpected<Error> no_place(std::string_view text) {
  return refuse_place(text, "is no place to begin: write X,Y,Z or X,Y,Z,YAW,PITCH, in metres and degrees");
}

}  // namespace

std::string text_of(const Spawn& spawn) {
  const auto number = [](float value) { return static_cast<double>(value) + 0.0; };  // no −0
  char text[128];
  std::snprintf(text, sizeof text, "%.2f,%.2f,%.2f,%.1f,%.1f", number(spawn.eye_m.x), number(spawn.eye_m.y),
                number(spawn.eye_m.z), number(spawn.yaw_degrees), number(spawn.pitch_degrees));
  return text;
}

Result<Spawn> parse_spawn(std::string_view text) {
  std::array<float, numbers_max> numbers{};
  size_t count = 0;
  const char *at = text.data(), *const end = at + text.size();
  for (; count < numbers_max; ++count) {
    const auto [stopped, error] = std::from_chars(at, end, numbers[count]);
    if (error != std::errc() || !std::isfinite(numbers[count])) return no_place(text);
    at = stopped;
    if (at == end) break;
    if (*at++ != ',') return no_place(text);
  }
  if (at != end || (++count != numbers_of_place && count != numbers_max)) return no_place(text);
  const auto& [x, y, z, yaw, pitch] = numbers;
  const bool inside = std::max(std::abs(x), std::abs(z)) <= limits::world_half_width_m &&
                      std::abs(y) <= limits::world_half_height_m;
  if (!inside)
    return refuse_place(text, "is outside the world (limits.world_half_width_m, world_half_height_m)");
  if (std::abs(pitch) > spawn_pitch_max_degrees)
    return refuse_place(text, "looks too steeply: its pitch is within ±89 degrees");
  return Spawn{{x, y, z}, std::remainder(yaw, 360.0F), pitch};
}

Spawn rounded(const Spawn& spawn) {
  return parse_spawn(text_of(spawn)).value_or(spawn);
}

}  // namespace scree
