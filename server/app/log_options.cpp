#include "server/app/log_options.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "shared/base/listed.h"

namespace scree {

namespace {

/// A line for each part.
std::string parts_help() {
  std::string help;
  for (const LogPart part : all_kinds<LogPart>)
    help += "\n  " + std::string(name_of(part)) + ": " + std::string(row_of(part).what);
  return help;
}

}  // namespace

void declare_log_options(CLI::App& app, LogConfig& log) {
  const auto set_levels = [&log](const std::vector<std::string>& levels) {
    for (const std::string& level : levels)
      if (const auto added = add_level(log, level); !added)
        throw CLI::ValidationError("--log", added.error().message);
  };
  app.add_option_function<std::vector<std::string>>(
         "--log", set_levels,
         "lowest level of logged lines: " + listed(kind_names<LogLevel>) +
             "; net=debug for one part, repeatable. The parts:" + parts_help())
      ->take_all()
      ->default_str("info");
  app.add_option_function<std::string>(
         "--log-format", [&log](const std::string& name) { log.format = *kind_named<LogFormat>(name); },
         "text, or json: an object a line")
      ->check(
          CLI::IsMember(std::vector<std::string>(kind_names<LogFormat>.begin(), kind_names<LogFormat>.end())))
      ->default_str("text");
}

}  // namespace scree
