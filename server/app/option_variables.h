// The environment as the server's options: which variable is which option's, before CLI11 reads it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace scree {

/// --sessions-max is SCREE_SESSIONS_MAX. Returns all names.
std::vector<std::string> name_variables(CLI::App& app);
/// A variable that says no to a flag counts for CLI11 as the flag, and what the flag needs would be missing.
/// Flags that need nothing may be on without a word, and no turns them off.
void forget_flags_that_say_no(const CLI::App& app);
/// CLI11 reads the file of options before it reads variables, and so none that a variable names.
std::vector<const char*> with_config_of_environment(std::vector<const char*> arguments);

}  // namespace scree
