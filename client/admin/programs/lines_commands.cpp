// audit, log, figures and bounds: what the server keeps for administrators line by line.
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

Printed print_lines(const AdminServer& server, const ListLinesRequest& request, bool as_json) {
  const Result<std::string> said = list_lines(server, request);
  if (!said) return tl::unexpected(Failed(said.error()));
  Result<std::string> text = as_json ? lines_json(*said) : lines_text(*said, request.of);
  if (!text) return tl::unexpected(Failed(text.error()));
  return std::move(*text);
}

void add_lines(CLI::App& app, LinesOf of, const std::string& name, const std::string& what,
               WorldCommands& table) {
  CLI::App* const command = app.add_subcommand(name, what);
  const auto most = std::make_shared<uint32_t>(0);
  if (of != LinesOf::settings)
    bounded(command->add_option("--most", *most, "only the newest so many"), whole_within(1, 1e6));
  table.push_back({command, [of, most](const AdminServer& server, bool as_json) {
                     return print_lines(server, {of, *most}, as_json);
                   }});
}

}  // namespace

void add_lines_commands(CLI::App& app, WorldCommands& table) {
  add_lines(app, LinesOf::audit, "audit", "prints what administrators did, and who", table);
  add_lines(app, LinesOf::log, "log", "prints the newest lines of the server's log", table);
  add_lines(app, LinesOf::figures, "figures", "prints the server's figures of the last hour, by ten seconds",
            table);
  add_lines(app, LinesOf::settings, "bounds", "prints all settings with their values, bounds and meaning",
            table);
}

}  // namespace scree
