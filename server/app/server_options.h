// The command line of scree-server: flags, a TOML file with the same names (--config), and the environment
// (SCREE_PORT for --port, and so on). The command line wins over the file, that over the environment, and
// that over a preset (shared/base/preset.h).
#pragma once

#include <string>
#include <variant>

#include "content/files/model_folder.h"
#include "server/app/live_server.h"
#include "server/rules/rules.h"

namespace scree {

struct ServerOptions {
  LiveConfig live;
  std::string report_path;        ///< empty: none
  std::string token_made;         ///< file of an admin token that was made; empty: none
  std::vector<ModelFile> models;  ///< live.models, for the log
  std::string log_level = "info";
  RulesOptions rules;  ///< without folders: there are none
};

/// The options; or the exit code when there is nothing to run: 0 after --help, 2 after an error, which is
/// printed.
std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv);

}  // namespace scree
