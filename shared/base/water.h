// Water as a level of the ground: drawn by clients, and without effect on anything else. A setting says it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shared/base/result.h"
#include "shared/base/setting_value.h"

namespace scree {

/// The name of the setting.
inline constexpr std::string_view water_setting = "water";

/// Height of the surface, metres; nothing: there is no water.
using WaterLevel = std::optional<float>;

/// "off", or a height within the world.
Result<WaterLevel> parse_water(std::string_view text);
/// In hundredths of a metre, which parse_water() reads back.
std::string text_of_water(WaterLevel level_m);

/// As settings say it; nothing, too, where they do not say it, or wrongly.
WaterLevel water_of(const SettingValues& settings);

}  // namespace scree
