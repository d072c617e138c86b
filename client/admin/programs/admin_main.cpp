// scree-admin: shows the status of a running server, and shows and changes its settings. Exit status: 0
// success, 1 failure or refusal, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/token.h"

namespace {

constexpr int exit_failed = 1;
constexpr int exit_usage = 2;

struct Options {
  scree::AdminServer server;
  double timeout_s = 10.0;
  std::string token;
  std::string token_file;
  std::vector<std::string> changes;
  bool json = false;
};

int complain(const scree::Error& error, int code) {
  std::fprintf(stderr, "scree-admin: error: %s\n", error.message.c_str());
  return code;
}

int print(const scree::Result<scree::SettingValues>& settings, bool as_json) {
  if (!settings) return complain(settings.error(), exit_failed);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const scree::SettingValue& setting : *settings) {
    json[setting.name] = setting.value;
    if (!as_json) std::printf("%-14s %s\n", setting.name.c_str(), setting.value.c_str());
  }
  if (as_json) std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

int print(const scree::Result<scree::StatusMessage>& status, bool as_json) {
  if (!status) return complain(status.error(), exit_failed);
  std::fputs((as_json ? scree::status_json(*status) : scree::status_lines(*status)).c_str(), stdout);
  return 0;
}

scree::Result<std::string> token_of(const Options& options) {
  if (!options.token_file.empty()) return scree::read_token(options.token_file);
  if (options.token.empty())
    return scree::fail("changing settings takes the server's token (--token-file, --token)");
  return options.token;
}

scree::Result<scree::SettingValues> parse(const std::vector<std::string>& changes) {
  scree::SettingValues parsed;
  for (const std::string& change : changes) {
    const size_t sign = change.find('=');
    if (sign == std::string::npos || sign == 0) return scree::fail("'" + change + "' is not NAME=VALUE");
    parsed.push_back({change.substr(0, sign), change.substr(sign + 1)});
  }
  return parsed;
}

int change(const Options& options) {
  const auto changes = parse(options.changes);
  if (!changes) return complain(changes.error(), exit_usage);
  const auto token = token_of(options);
  if (!token) return complain(token.error(), exit_usage);
  return print(scree::change_settings(options.server, *token, *changes), options.json);
}

void add_connection(CLI::App& app, Options& options) {
  app.add_option("--host", options.server.host, "server to connect to")
      ->envname("SCREE_HOST")
      ->capture_default_str();
  app.add_option("--port", options.server.port, "its port")->envname("SCREE_PORT")->capture_default_str();
  app.add_option("--timeout", options.timeout_s, "seconds to wait for its answers")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", options.json, "prints JSON");
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Shows how a running server stands, and shows and changes its settings.", "scree-admin");
  app.require_subcommand(1);
  add_connection(app, options);
  app.fallthrough();
  const CLI::App* show = app.add_subcommand("show", "prints every setting as it stands");
  const CLI::App* status =
      app.add_subcommand("status", "prints what the last second's ticks took and had to do, and the ledger");
  CLI::App* set = app.add_subcommand("set", "changes settings, all or none, and prints how every one stands");
  set->add_option("NAME=VALUE", options.changes, "scree-server --help lists them")->required();
  CLI::Option* token =
      set->add_option("--token", options.token, "the server's --admin-token")->envname("SCREE_ADMIN_TOKEN");
  set->add_option("--token-file", options.token_file, "its first line is the token")
      ->envname("SCREE_ADMIN_TOKEN_FILE")
      ->excludes(token);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  options.server.within = std::chrono::milliseconds(static_cast<int64_t>(options.timeout_s * 1000.0));
  if (show->parsed()) return print(scree::read_settings(options.server), options.json);
  if (status->parsed()) return print(scree::read_status(options.server), options.json);
  return change(options);
}
