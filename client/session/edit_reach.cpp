#include "client/session/edit_reach.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace scree {

namespace {

constexpr std::string_view reach_setting = "reach";

}  // namespace

std::optional<float> edit_reach_m(const std::optional<StatusMessage>& status, Role role) {
  if (!status || role == Role::admin) return std::nullopt;
  const auto found = std::ranges::find(status->settings, reach_setting, &SettingValue::name);
  if (found == status->settings.end()) return std::nullopt;
  const float reach_m = std::strtof(found->value.c_str(), nullptr);
  return reach_m > 0.0F ? std::optional(reach_m) : std::nullopt;
}

}  // namespace scree
