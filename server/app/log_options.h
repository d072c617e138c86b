// The options of a program of the server's side by which its operator says what is logged, and how.
#pragma once

#include "server/log/log_config.h"

namespace CLI {
class App;
}

namespace scree {

/// `log` outlives the parsing.
void declare_log_options(CLI::App& app, LogConfig& log);

}  // namespace scree
