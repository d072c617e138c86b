// Where the values of a command line's options come from: CLI11 does not keep that.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/app/option_value.h"

namespace CLI {
class App;
}

namespace scree {

class OptionSources {
 public:
  /// Looks at an app that has parsed, before a preset is applied. `arguments`: as the program got them.
  /// `config_path`: the file that was read; empty: none.
  OptionSources(const CLI::App& app, const std::vector<const char*>& arguments,
                const std::string& config_path);
  /// Every option, in the order of --help, as it stands now: what was set since comes from a preset.
  std::vector<OptionValue> values(const CLI::App& app) const;

 private:
  std::map<std::string, OptionSource> given_;  ///< by name
};

}  // namespace scree
