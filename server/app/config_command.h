// `scree-server config print` and `config check FILE`: the options as the server would take them, without
// starting it. They make and change nothing.
#pragma once

#include <string>
#include <vector>

#include "server/app/option_value.h"

namespace scree {

/// Whether the command line asks for them.
bool is_config_command(int argc, const char* const* argv);
/// Returns the exit status: 0; 1 where the options or the file are at fault; 2 for wrong usage.
int config_command(int argc, const char* const* argv);

/// A line each: name, where the value comes from, and the value.
std::string options_lines(const std::vector<OptionValue>& options);
std::string options_json(const std::vector<OptionValue>& options);

}  // namespace scree
