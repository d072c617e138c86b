// The table of settings: names, values and help of the members of Methods. The server's flags, its
// configuration file, the environment, requests to change settings, recordings and reports all use it. To add
// a setting: a member in methods.h, a row in settings.cpp, and the names of its values there. The tests of
// determinism take each value in turn.
#pragma once

#include <span>
#include <string_view>

#include "server/world/methods.h"
#include "shared/base/result.h"
#include "shared/base/setting_value.h"

namespace scree {

struct Setting {
  std::string_view name;                     ///< the flag's name without dashes; the same everywhere
  std::string_view help;                     ///< the effect, for --help
  std::span<const std::string_view> values;  ///< all possible values
  Result<void> (*parse)(std::string_view value, Methods& methods);  ///< the error lists the values
  std::string (*print)(const Methods& methods);
};

std::span<const Setting> settings();

/// Changes one setting; the error names it and lists its values.
Result<void> set(Methods& methods, const SettingValue& setting);
/// Changes all settings or none. An error: a name is unknown or comes twice, or a value is unknown.
Result<void> set_all(Methods& methods, const SettingValues& values);
/// Every setting, in the table's order.
SettingValues print(const Methods& methods);

}  // namespace scree
