// Requests on their way to the world, and what rules say of them.
#include "server/rules/request_table.h"
#include "server/rules/rules.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Whether scripts decide on it: not on inputs of walking, which are many, nor on what the server itself,
/// administrators or the network side ask for.
bool is_decided(const Command& command) {
  return command.session != 0 && !std::holds_alternative<LeaveRequest>(command.body) &&
         !std::holds_alternative<WalkRequest>(command.body) &&
         !std::holds_alternative<SettingsRequest>(command.body) &&
         !std::holds_alternative<RulesRequest>(command.body);
}

constexpr std::string_view busy_name = "rules_busy", failed_name = "rules_failed", refused_name = "rules";

}  // namespace

void Rules::decide(TickCommands& commands, RulesMoment& moment, ScriptBudget& budget) {
  if (!is_wanted("request")) return;
  // What the rules themselves ask for comes after these, and is not decided on.
  for (size_t i = 0, count = commands.all().size(); i < count; ++i)
    if (is_decided(commands.all()[i]) && !commands.is_refused(i)) decide_on(i, commands, moment, budget);
}

void Rules::decide_on(size_t index, TickCommands& commands, RulesMoment& moment, ScriptBudget& budget) {
  for (const auto& mod : mods_) {
    if (!mod->has_handler("request") || commands.is_refused(index)) continue;
    if (mod->any_rests("request", moment))
      return commands.refuse(index, "a rule of this game failed too often, and decides on nothing for now",
                             failed_name);
    if (budget.work <= 0 || budget.cpu_s <= 0.0)
      return commands.refuse(index, "the rules of this game have no time: ask again", busy_name);
    const auto write = [&](ScriptWriter& to) {
      const Command& command = commands.all()[index];
      to.open_table();
      to.name("kind");
      to.text(kind_of(command.body));
      to.name("by");
      to.handle({"person", command.session});
      write_request(to, command.body, moment);
      to.close_table();
    };
    const auto answered = [&](const ScriptValue& value) -> Result<bool> {
      if (value.is_nil()) return true;
      if (value.is_table()) {
        commands.change(index, TRY(changed_request(commands.all()[index].body, value, moment)));
        return true;
      }
      std::string words = "the rules of this game do not allow it";
      if (value.is_text())
        words = showable(std::string(TRY(value.text())), limits::notice_line_bytes_max);
      else if (TRY(value.boolean()))
        return true;
      commands.refuse(index, words.empty() ? "no" : words, refused_name);
      return false;
    };
    const uint64_t faults = mod->faults();
    mod->tell("request", moment, budget, write, answered);
    if (mod->faults() != faults && !commands.is_refused(index))
      commands.refuse(index, "a rule of this game failed: the server's log says why", failed_name);
  }
}

}  // namespace scree
