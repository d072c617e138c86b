// A setting as people and programs write it: its name and its value, both text. The server's table of
// settings (server/world/settings.h) lists them and says their meaning.
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
