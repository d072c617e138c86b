#include "shared/base/water.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "shared/base/limits.h"

namespace scree {

namespace {

constexpr std::string_view no_water = "off";

}  // namespace

Result<WaterLevel> parse_water(std::string_view text) {
  if (text == no_water) return WaterLevel();
  // The page's library has no from_chars() for these numbers, and strtof() takes more than plain ones.
  const bool is_plain = text.find_first_not_of("-.0123456789") == std::string_view::npos;
  const std::string number(text);
  char* end = nullptr;
  const float level_m = std::strtof(number.c_str(), &end);
  const bool is_number = is_plain && !number.empty() && end == number.c_str() + number.size();
  if (!is_number || std::abs(level_m) > limits::world_half_height_m)
    return fail("a height is a number from -512 to 512");
  return WaterLevel(level_m);
}

std::string text_of_water(WaterLevel level_m) {
  if (!level_m) return std::string(no_water);
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", static_cast<double>(*level_m) + 0.0);  // no −0
  return text;
}

WaterLevel water_of(const SettingValues& settings) {
  const auto found = std::ranges::find(settings, water_setting, &SettingValue::name);
  return found == settings.end() ? WaterLevel() : parse_water(found->value).value_or(WaterLevel());
}

}  // namespace scree
