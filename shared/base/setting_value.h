// A setting as people and programs write it: its name and its value, both text. Which there are, and what
// they mean, the server's table says (server/world/settings.h).
#pragma once

#include <string>
#include <vector>

namespace scree {

struct SettingValue {
  std::string name;
  std::string value;

  bool operator==(const SettingValue&) const = default;
};

using SettingValues = std::vector<SettingValue>;

}  // namespace scree
