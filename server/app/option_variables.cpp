#include "server/app/option_variables.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace scree {

std::vector<std::string> name_variables(CLI::App& app) {
  std::vector<std::string> names;
  for (CLI::Option* option : app.get_options()) {
    const std::string flag = option->get_lnames().empty() ? "help" : option->get_lnames().front();
    if (flag == "help" || flag == "version") continue;
    std::string name = "SCREE_";
    for (const char c : flag)
      name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    option->envname(name);
    names.push_back(std::move(name));
  }
  return names;
}

void forget_flags_that_say_no(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const char* const value = std::getenv(option->get_envname().c_str());
    if (value == nullptr || option->get_items_expected_max() != 0 || option->get_needs().empty()) continue;
    bool is_wanted = true;
    if (CLI::detail::lexical_cast(value, is_wanted) && !is_wanted) unsetenv(option->get_envname().c_str());
  }
}

std::vector<const char*> with_config_of_environment(std::vector<const char*> arguments) {
  static constexpr std::string_view flag = "--config";
  const auto is_given = [](const char* argument) {
    const std::string_view text(argument);
    return text == flag || (text.starts_with(flag) && text[flag.size()] == '=');
  };
  const char* const path = std::getenv("SCREE_CONFIG");
  if (path == nullptr || *path == '\0' || arguments.empty() || std::ranges::any_of(arguments, is_given))
    return arguments;
  arguments.insert(arguments.begin() + 1, {flag.data(), path});
  return arguments;
}

}  // namespace scree
