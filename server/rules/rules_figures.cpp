// The figures of rules, for operators.
#include "server/rules/rules.h"

namespace scree {

namespace {

/// A figure that each mod has.
struct ModFigure {
  const char* name;
  const char* help;
  FigureKind kind;
  double (*value)(const Mod& mod);
};

double sum_over_handlers(const Mod& mod, uint64_t HandlerState::*count) {
  uint64_t sum = 0;
  for (const HandlerState& handler : mod.handlers()) sum += handler.*count;
  return static_cast<double>(sum);
}

constexpr ModFigure mod_figures[] = {
    {"scree_rules_memory_bytes", "Memory that the script holds.", FigureKind::state,
     [](const Mod& mod) { return static_cast<double>(mod.script().used().memory_bytes); }},
    {"scree_rules_cpu_seconds_total", "Processor time of all calls.", FigureKind::total,
     [](const Mod& mod) { return mod.script().used().cpu_s; }},
    {"scree_rules_calls_total", "Calls of handlers of events.", FigureKind::total,
     [](const Mod& mod) { return sum_over_handlers(mod, &HandlerState::calls); }},
    {"scree_rules_faults_total", "Calls that failed, of timers, too.", FigureKind::total,
     [](const Mod& mod) { return static_cast<double>(mod.faults()); }},
    {"scree_rules_timers", "Timers that run.", FigureKind::state,
     [](const Mod& mod) { return static_cast<double>(mod.timers()); }},
};

}  // namespace

/// Once a second.
void Rules::note_figures() {
  std::vector<Figure> figures;
  for (const ModFigure& row : mod_figures)
    for (const auto& mod : mods_)
      figures.push_back({row.name, row.help, row.kind, row.value(*mod), {{"rules", mod->name()}}});
  figures.push_back({"scree_rules_happenings_waiting", "Happenings that rules have not been told yet.",
                     FigureKind::state, static_cast<double>(waiting_.size())});
  const std::scoped_lock lock(mutex_);
  figures_ = std::move(figures);
}

std::vector<Figure> Rules::figures() const {
  const std::scoped_lock lock(mutex_);
  return figures_;
}

}  // namespace scree
