// The one table of what can be set: names, values and help of the members of Methods. The server's flags, its
// configuration file, the environment, requests to change settings, recordings and reports all go by it. To
// add a setting: a member in methods.h, a row in settings.cpp, and the names of its values there. The tests
// of determinism take each value in turn.
#pragma once

#include <span>
#include <string_view>

#include "server/world/methods.h"
#include "shared/base/result.h"
#include "shared/base/setting_value.h"

namespace scree {

struct Setting {
  std::string_view name;                     ///< of the flag without its dashes, and everywhere else
  std::string_view help;                     ///< what it decides
  std::span<const std::string_view> values;  ///< all that it may be
  Result<void> (*parse)(std::string_view value, Methods& methods);  ///< the error says what it may be
  std::string (*print)(const Methods& methods);
};

std::span<const Setting> settings();

/// "field, mesh or rays"
std::string listed(std::span<const std::string_view> names);

/// Changes one by its name; the error names it, and what it may be.
Result<void> set(Methods& methods, const SettingValue& setting);
/// Changes all, or none: no name that is unknown or comes twice, no value that is none.
Result<void> set_all(Methods& methods, const SettingValues& values);
/// Every setting, in the table's order.
SettingValues print(const Methods& methods);

}  // namespace scree
