#include "server/app/config_file.h"

#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <vector>

#include "server/app/config_entries.h"

namespace scree {

std::string named_file(const CLI::Option& config) {
  const std::vector<std::string>& given = config.results();
  return given.size() == 1 ? given.front() : std::string();
}

std::string fault_in_file(const std::string& path, const EntryCheck& fault_of) {
  std::ifstream file(path);
  for (const ConfigEntry& entry : config_entries(file)) {
    const std::string place = fmt::format("{}:{}: ", path, entry.line);
    if (!entry.closed) return place + "a list that does not end";
    std::istringstream text(entry.text);
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(text)) {
      const bool section = item.name == "++" || item.name == "--";
      const std::string fault = section ? "options must not be in a section" : fault_of(item);
      if (!fault.empty()) return place + fault;
    }
  }
  return {};
}

}  // namespace scree
