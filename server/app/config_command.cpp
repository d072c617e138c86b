#include "server/app/config_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

#include "server/app/server_options.h"
#include "server/doors/access.h"
#include "shared/base/near_name.h"
#include "shared/base/program_output.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

constexpr int at_fault = 1, misuse = 2;
constexpr const char* not_shown = "(not shown)";

int say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  const auto printed = flush_output();
  if (!printed) std::fprintf(stderr, "scree-server config: error: %s\n", printed.error().message.c_str());
  return printed ? 0 : at_fault;
}

Json json_of(const OptionValue& option) {
  Json value = nullptr;
  if (!option.is_secret && option.is_list) value = option.values;
  if (!option.is_secret && !option.is_list && !option.values.empty()) value = option.text();
  Json json{{"value", std::move(value)}, {"from", name_of(option.source)}};
  if (option.is_secret) json["secret"] = true;
  return json;
}

/// A file that is wrong ends with 1, as the options of `print` do: the command itself was right.
int end_of(OptionsEnd end) {
  if (end.code != 0) end.code = at_fault;
  return print_end(end);
}

int print_options(const std::vector<const char*>& arguments, bool as_json) {
  const auto read =
      read_server_options(static_cast<int>(arguments.size()), arguments.data(), OptionsUse::look);
  if (const auto* end = std::get_if<OptionsEnd>(&read)) return end_of(*end);
  const auto& values = std::get<ServerOptions>(read).values;
  return say(as_json ? options_json(values) : options_lines(values));
}

int check_options(const char* program, const std::string& file) {
  const std::vector<const char*> arguments{program, "--config", file.c_str()};
  const auto read =
      read_server_options(static_cast<int>(arguments.size()), arguments.data(), OptionsUse::look);
  if (const auto* end = std::get_if<OptionsEnd>(&read)) return end_of(*end);
  const auto& options = std::get<ServerOptions>(read);
  const NetConfig& net = options.live.net;
  if (const auto access = Access::load(net.access, net.admin_token); !access)
    return end_of({at_fault, "", fmt::format("scree-server: {}: {}\n", file, access.error().message)});
  const auto set = std::ranges::count(options.values, OptionSource::file, &OptionValue::source);
  return say(fmt::format("{}: {} options, no fault\n", file, set));
}

}  // namespace

std::string options_lines(const std::vector<OptionValue>& options) {
  size_t widest = 0;
  for (const OptionValue& option : options) widest = std::max(widest, option.name.size());
  std::string lines;
  for (const OptionValue& option : options) {
    const bool is_given = option.source != OptionSource::standard;
    const std::string text = option.is_secret && is_given ? not_shown : option.text();
    lines += fmt::format("{:<{}}  {:<11}  {}", option.name, widest, name_of(option.source), text);
    lines.erase(lines.find_last_not_of(' ') + 1);
    lines += '\n';
  }
  return lines;
}

std::string options_json(const std::vector<OptionValue>& options) {
  Json json = Json::object();
  for (const OptionValue& option : options) json[option.name] = json_of(option);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool is_config_command(int argc, const char* const* argv) {
  return argc >= 2 && std::string_view(argv[1]) == "config";
}

int config_command(int argc, const char* const* argv) {
  CLI::App app("Shows or checks the options of the server, without starting it.", "scree-server config");
  name_unknown_words<CLI::ExtrasError>(app);
  app.require_subcommand(1);
  bool as_json = false;
  std::string file;
  CLI::App* const print = app.add_subcommand(
      "print",
      "prints every option with its value, and whether that is a default or comes from the preset, "
      "the environment, the file or a flag; takes all options of the server");
  print->add_flag("--json", as_json, "prints JSON");
  print->allow_extras();
  print->set_help_flag();
  CLI::App* const check = app.add_subcommand(
      "check", "reads a file of options as the server would; exits with 1 when something is wrong in it");
  check->add_option("FILE", file, "the file (TOML)")->required();
  try {
    app.parse(argc - 1, argv + 1);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : misuse;
  }
  if (check->parsed()) return check_options(argv[0], file);
  std::vector<std::string> rest = print->remaining();
  std::vector<const char*> arguments{argv[0]};
  for (const std::string& word : rest) arguments.push_back(word.c_str());
  return print_options(arguments, as_json);
}

}  // namespace scree
