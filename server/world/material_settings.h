// Numbers of the palette that administrators change while a world runs, as settings:
// "material.brick.strength". So they are recorded, replayed, kept and listed as all settings are. Names,
// order and ground of the palette never change, nor do choices and images: only its file has them. Any
// thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "shared/base/result.h"
#include "shared/base/setting_value.h"
#include "shared/material/palette.h"

namespace scree {

/// What a setting of a material's number begins with; the row's name, a point and the member's name follow.
inline constexpr std::string_view material_prefix = "material.";

/// The value of such a setting that takes the palette's own number again.
inline constexpr std::string_view own_number = "default";

/// The numbers that differ from the palette's own, by "row.member".
using MaterialNumbers = std::map<std::string, float>;

inline bool is_material_setting(std::string_view name) {
  return name.starts_with(material_prefix);
}

/// Changes one number; one that is the palette's own leaves the list. The error names the row, the member and
/// its bounds, or the nearest name; `numbers` stay then. Refuses more than limits::material_settings_max.
Result<void> set_material(const Palette& own, MaterialNumbers& numbers, const SettingValue& setting);

/// As settings, by name.
SettingValues print(const MaterialNumbers& numbers);

/// The palette with the numbers; `own` itself where there are none. `own` has their rows.
std::shared_ptr<const Palette> palette_with(const std::shared_ptr<const Palette>& own,
                                            const MaterialNumbers& numbers);
/// The same by settings, of which others are left out, as are those that the palette cannot have: a recording
/// may be of another program.
std::shared_ptr<const Palette> palette_with(const std::shared_ptr<const Palette>& own,
                                            const SettingValues& settings);

}  // namespace scree
