#include "server/app/config_entries.h"

#include <utility>

namespace scree {
namespace {

bool is_open_list(const std::string& entry) {
  const size_t equals = entry.find('=');
  if (equals == std::string::npos) return false;
  const size_t value = entry.find_first_not_of(" \t", equals + 1);
  return value != std::string::npos && entry[value] == '[' && entry.find(']', value) == std::string::npos;
}

}  // namespace

std::vector<ConfigEntry> config_entries(std::istream& file) {
  std::vector<ConfigEntry> entries;
  size_t line = 0;
  for (std::string text; std::getline(file, text);) {
    ConfigEntry entry{++line, std::move(text), true};
    for (std::string more; is_open_list(entry.text) && std::getline(file, more); ++line) entry.text += more;
    entry.closed = !is_open_list(entry.text);
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace scree
