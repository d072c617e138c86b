// The names that folders of rules may have: they go into commands, keys and messages.
#pragma once

#include <algorithm>
#include <string_view>

#include "server/rules/limits.h"

namespace scree {

inline bool is_mod_name(std::string_view name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= limits::mod_name_bytes_max && std::ranges::all_of(name, fits);
}

}  // namespace scree
