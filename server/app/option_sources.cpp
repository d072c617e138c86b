#include "server/app/option_sources.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <string_view>

namespace scree {

namespace {

/// The second may hold a password.
constexpr std::string_view secret_options[] = {"admin-token", "nats"};

std::string long_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? std::string() : option.get_lnames().front();
}

/// Those that end the program are none of its options.
bool is_told(const std::string& name) {
  return !name.empty() && name != "help" && name != "version";
}

bool names(std::string_view argument, const CLI::Option& option) {
  const auto is = [&](const std::string& flag) {
    return argument == flag || (argument.starts_with(flag) && argument[flag.size()] == '=');
  };
  return std::ranges::any_of(option.get_lnames(), [&](const auto& name) { return is("--" + name); }) ||
         std::ranges::any_of(option.get_snames(), [&](const auto& name) {
           return !argument.starts_with("--") && argument.starts_with("-" + name);
         });
}

std::set<std::string> names_in_file(const std::string& path) {
  std::set<std::string> names;
  if (path.empty()) return names;
  std::ifstream file(path);
  for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(file)) names.insert(item.fullname());
  return names;
}

}  // namespace

std::string OptionValue::text() const {
  return is_secret ? std::string() : fmt::format("{}", fmt::join(values, ","));
}

OptionSources::OptionSources(const CLI::App& app, const std::vector<const char*>& arguments,
                             const std::string& config_path) {
  const std::set<std::string> in_file = names_in_file(config_path);
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = long_name(*option);
    if (!is_told(name) || option->count() == 0) continue;
    const bool is_flag = std::any_of(arguments.begin() + (arguments.empty() ? 0 : 1), arguments.end(),
                                     [&](const char* argument) { return names(argument, *option); });
    const bool is_of_file =
        std::ranges::any_of(option->get_lnames(), [&](const auto& one) { return in_file.contains(one); });
    given_[name] = is_flag ? OptionSource::flag : is_of_file ? OptionSource::file : OptionSource::environment;
  }
}

std::vector<OptionValue> OptionSources::values(const CLI::App& app) const {
  std::vector<OptionValue> all;
  for (const CLI::Option* option : app.get_options()) {
    OptionValue value;
    value.name = long_name(*option);
    if (!is_told(value.name)) continue;
    value.is_secret = std::ranges::find(secret_options, value.name) != std::end(secret_options);
    value.is_list = option->get_items_expected_max() > 1;
    const bool is_switch = option->get_items_expected_max() == 0;
    if (option->count() > 0) {
      const auto found = given_.find(value.name);
      value.source = found == given_.end() ? OptionSource::preset : found->second;
      value.values = option->results();
    } else if (is_switch) {
      value.values = {"false"};
    } else if (!option->get_default_str().empty()) {
      value.values = {option->get_default_str()};
    }
    all.push_back(std::move(value));
  }
  return all;
}

}  // namespace scree
