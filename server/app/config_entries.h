// The entries of a file of options (TOML): each is a line, but lists go on until they are closed.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace scree {

struct ConfigEntry {
  size_t line = 0;  ///< its first, from 1
  std::string text;
  bool closed = true;  ///< false: a list that the file ends in
};

std::vector<ConfigEntry> config_entries(std::istream& file);

}  // namespace scree
