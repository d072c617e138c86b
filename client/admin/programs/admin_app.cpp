#include "client/admin/programs/admin_app.h"

#include <cstdio>

#include "shared/base/near_name.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

int run_on_world(const WorldCommand& command, const AdminServer& server, bool as_json) {
  const Printed printed = command.run(server, as_json);
  if (!printed)
    return complain({printed.error().message}, printed.error().misused ? exit_usage : exit_failed);
  std::fputs(printed->c_str(), stdout);
  return 0;
}

}  // namespace

AdminApp::AdminApp(CLI::App& app, const AdminSettings& settings) : settings_(settings) {
  app.require_subcommand(0, 1);  // a mistyped one would pass as none
  name_unknown_words<CLI::ExtrasError>(app);
  bounded(app.add_option("--timeout", settings_.timeout_s, "seconds to wait for the server's answers"),
          {0.1, 3600.0})
      ->capture_default_str();
  app.add_flag("--json", settings_.json, "prints JSON");
  app.fallthrough();
  commands_ = add_server_commands(app, options_);
  add_list_commands(app, of_world_);
  add_prop_commands(app, of_world_);
  add_joint_commands(app, of_world_);
  add_ask_commands(app, of_world_);
  add_region_commands(app, of_world_);
  add_store_commands(app, of_world_);
  add_rules_commands(app, of_world_);
  add_history_commands(app, of_world_);
  add_flight_commands(app, of_world_);
  add_lines_commands(app, of_world_);
}

int AdminApp::run(const AdminServer& server) {
  options_.server = server;
  options_.server.within = settings_.within();
  options_.json = settings_.json;
  for (const auto& [command, run] : commands_)
    if (command->parsed()) return run(options_);
  for (const WorldCommand& command : of_world_)
    if (command.command->parsed()) return run_on_world(command, options_.server, settings_.json);
  return exit_usage;
}

}  // namespace scree
