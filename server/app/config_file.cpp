#include "server/app/config_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <vector>

#include "server/app/config_entries.h"
#include "server/app/limits.h"
#include "shared/base/regular_file.h"

namespace scree {

namespace {

/// A section's head, or a name with a dot.
bool is_in_section(std::string_view entry) {
  const std::string_view name = entry.substr(0, entry.find('='));
  const size_t first = name.find_first_not_of(" \t");
  return first != name.npos && (name[first] == '[' || (name[first] != '"' && name.find('.') != name.npos));
}

}  // namespace

std::string named_file(const CLI::Option& config) {
  const std::vector<std::string>& given = config.results();
  return given.size() == 1 ? given.front() : std::string();
}

std::string fault_of_file(const std::string& path) {
  if (const auto checked = check_no_device(path); !checked) return checked.error().message;
  std::ifstream file(path, std::ios::binary);
  std::string text(limits::config_bytes_max + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(file.gcount()));
  if (text.size() > limits::config_bytes_max)
    return fmt::format("{}: more than {} KiB are no file of options (limits.config_bytes_max)", path,
                       limits::config_bytes_max >> 10U);
  if (static_cast<size_t>(std::ranges::count(text, '\n')) > limits::config_lines_max)
    return fmt::format("{}: more than {} lines are no file of options (limits.config_lines_max)", path,
                       limits::config_lines_max);
  std::istringstream lines(text);
  const std::vector<ConfigEntry> entries = config_entries(lines);
  const auto is_value = [](const ConfigEntry& entry) {
    const size_t first = entry.text.find_first_not_of(" \t\r\n");
    return first != std::string::npos && entry.text[first] != '#';
  };
  if (static_cast<size_t>(std::ranges::count_if(entries, is_value)) > limits::config_values_max)
    return fmt::format("{}: more than {} values are no file of options (limits.config_values_max)", path,
                       limits::config_values_max);
  // The library takes a time that grows with the square of the sections in sections, so it sees none.
  for (const ConfigEntry& entry : entries) {
    if (!is_value(entry)) continue;
    if (!entry.closed) return fmt::format("{}:{}: a list that does not end", path, entry.line);
    if (is_in_section(entry.text))
      return fmt::format("{}:{}: options must not be in a section", path, entry.line);
  }
  return {};
}

std::string fault_in_file(const std::string& path, const EntryCheck& fault_of) {
  if (!fault_of_file(path).empty()) return {};
  std::ifstream file(path);
  for (const ConfigEntry& entry : config_entries(file)) {
    const std::string place = fmt::format("{}:{}: ", path, entry.line);
    std::istringstream text(entry.text);
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(text)) {
      const std::string fault = fault_of(item);
      if (!fault.empty()) return place + fault;
    }
  }
  return {};
}

}  // namespace scree
