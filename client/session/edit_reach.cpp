#include "client/session/edit_reach.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace scree {

namespace {

constexpr std::string_view reach_setting = "reach", store_setting = "store-m3";

std::optional<float> number_of(const std::optional<StatusMessage>& status, std::string_view setting) {
  if (!status) return std::nullopt;
  const auto found = std::ranges::find(status->settings, setting, &SettingValue::name);
  if (found == status->settings.end()) return std::nullopt;
  return std::strtof(found->value.c_str(), nullptr);
}

}  // namespace

std::optional<float> edit_reach_m(const std::optional<StatusMessage>& status, Role role) {
  const std::optional<float> reach_m = number_of(status, reach_setting);
  return role != Role::admin && reach_m.value_or(0.0F) > 0.0F ? reach_m : std::nullopt;
}

std::optional<float> store_room_m3(const std::optional<StatusMessage>& status) {
  return number_of(status, store_setting);
}

}  // namespace scree
