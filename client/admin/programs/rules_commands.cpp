// rules list, reload and console.
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "proto/limits.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

/// The wish, or why it is none.
tl::expected<ControlRulesRequest, Failed> console_of(const ControlRulesRequest& words) {
  if (words.line.empty()) return misused({"the line is empty"});
  if (words.line.size() > limits::console_line_bytes_max)
    return misused({"the line has more than " + std::to_string(limits::console_line_bytes_max) +
                    " bytes (limits.console_line_bytes_max)"});
  if (words.line.find('\n') != std::string::npos)
    return misused({"a console takes one line: put the rest into a file of the rules"});
  if (words.rules.size() > limits::region_name_bytes_max)
    return misused(
        {"a name of rules has at most " + std::to_string(limits::region_name_bytes_max) + " bytes"});
  return words;
}

/// Rules say what went wrong in words, which begin so: then the command fails, and prints them alone.
Printed control(const AdminServer& server, const ControlRulesRequest& wish, bool as_json) {
  const Result<std::string> said = control_rules(server, wish);
  constexpr std::string_view failed = "error: ";
  if (said && said->starts_with(failed)) return tl::unexpected(Failed(Error{said->substr(failed.size())}));
  return print_said(said, as_json ? rules_json : rules_lines);
}

}  // namespace

void add_rules_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<ControlRulesRequest>();
  words->control = RulesControl::console;
  CLI::App* const rules = app.add_subcommand("rules", "shows and controls the server's rules");
  rules->require_subcommand(1);
  rules->fallthrough();
  CLI::App* const list =
      rules->add_subcommand("list", "prints the rules that run, and what became of their handlers");
  CLI::App* const reload = rules->add_subcommand("reload", "reads the rules again; nobody is dropped");
  CLI::App* const console =
      rules->add_subcommand("console", "runs a line in the rules, and prints its result");
  console->add_option("LINE", words->line, "a line of Lua, such as 'return 1 + 1'")->required();
  console->add_option("--rules", words->rules,
                      "the name of the rules that the line is for; default: the first");
  table.push_back(
      {list, [](const AdminServer& server, bool as_json) { return control(server, {}, as_json); }});
  table.push_back({reload, [](const AdminServer& server, bool as_json) {
                     return control(server, {RulesControl::reload, {}, {}}, as_json);
                   }});
  table.push_back({console, [words](const AdminServer& server, bool as_json) -> Printed {
                     const auto wish = TRY(console_of(*words));
                     return control(server, wish, as_json);
                   }});
}

}  // namespace scree
