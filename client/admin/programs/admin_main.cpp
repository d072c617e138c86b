// scree-admin: shows the status of a running server, shows and changes its settings, manages its sessions,
// and lists, asks about and changes the bodies of its world. Exit status: 0 success, 1 failure or refusal, 2
// wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "client/admin/programs/admin_app.h"
#include "client/admin/programs/console_command.h"
#include "client/connection/endpoint_options.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Shows the state of a running server, changes its settings and its world, and manages its "
      "sessions.",
      "scree-admin");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::AdminServer server;
  scree::EndpointOptions endpoint(app, server, "SCREE_ADMIN_TOKEN", scree::EndpointNaming::or_socket);
  scree::AdminApp commands(app, {});
  const CLI::App* const console = app.add_subcommand(
      "console",
      "reads these subcommands, a line each; on a terminal with history and completion, else without a "
      "prompt, and exits with 1 when a line failed");
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : scree::exit_usage;
  }
  // Health needs no token, and an operator may keep the file that the environment names elsewhere.
  const bool asks_health = app.got_subcommand("health");
  if (asks_health) endpoint.drop_token();
  if (const auto completed = endpoint.complete(); !completed)
    return scree::complain(completed.error(), asks_health ? scree::exit_failed : scree::exit_usage);
  const int status =
      console->parsed() ? scree::run_console(server, commands.settings()) : commands.run(server);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return scree::complain(scree::Error{"the output cannot be written"}, scree::exit_failed);
  return status;
}
