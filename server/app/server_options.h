// The command line of scree-server: flags, a TOML file with the same names (--config), and the environment
// (SCREE_PORT for --port, and so on). The command line wins over the file, that over the environment, and
// that over a preset (shared/base/preset.h).
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "content/files/model_folder.h"
#include "server/agones/agones.h"
#include "server/app/bus_options.h"
#include "server/app/live_server.h"
#include "server/app/option_value.h"
#include "server/log/log_config.h"
#include "server/rules/rules.h"

namespace scree {

struct ServerOptions {
  LiveConfig live;
  std::string report_path;        ///< empty: none
  std::string token_made;         ///< file of an admin token that was made; empty: none
  std::vector<ModelFile> models;  ///< live.models, for the log
  BusOptions bus;
  AgonesConfig agones;
  LogConfig log;
  RulesOptions rules;               ///< without folders: there are none
  std::vector<OptionValue> values;  ///< every option, and where it comes from
  std::string config_path;          ///< empty: there is no file
};

/// Why there is nothing to run: 0 after --help, 2 after an error; and what is to be printed.
struct OptionsEnd {
  int code = 0;
  std::string out, err;
};
/// Prints it, and returns the code.
int print_end(const OptionsEnd& end);

/// start: makes what is asked for, as an admin token. look: makes and changes nothing.
enum class OptionsUse : uint8_t { start, look };
using ServerOptionsRead = std::variant<ServerOptions, OptionsEnd>;
ServerOptionsRead read_server_options(int argc, const char* const* argv, OptionsUse use);

/// The options; or the exit code when there is nothing to run: 0 after --help, 2 after an error, which is
/// printed.
std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv);

}  // namespace scree
