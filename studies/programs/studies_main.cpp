// scree-studies: each subcommand answers a question by many measurements, and writes a report. Exit status: 0
// done, 1 something could not be done, 2 wrong usage, 3 a check was missed (with --strict).
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/programs/exit_codes.h"
#include "bench/programs/run_all.h"
#include "shared/base/option_check.h"
#include "studies/programs/run_study.h"

namespace scree {
namespace {

constexpr const char* strict_help = "exit with status 3 if a check fails";
constexpr const char* quick_help = "run fewer rounds and points, only to see that it runs";

int list() {
  for (const Study& study : all_studies())
    std::printf("%-12s %s\n", study.name.c_str(), study.summary.c_str());
  return exit_done;
}

CLI::App* add_study(CLI::App& app, const Study& study, StudyRun& run) {
  CLI::App* command = app.add_subcommand(study.name, study.summary);
  command->add_flag("--quick", run.quick, quick_help);
  command->add_option("--out", run.folder, "folder of the report")->capture_default_str();
  command->add_option("--json", run.json_file, "write the figures to this file")
      ->check(check_writable, "FILE");
  command->add_flag("--strict", run.strict, strict_help);
  return command;
}

CLI::App* add_all(CLI::App& app, AllRuns& runs, std::string& report_folder) {
  CLI::App* command = app.add_subcommand("all", "run every study, each in a process of its own");
  command->add_flag("--quick", runs.quick, quick_help);
  command->add_flag("--resume", runs.resume, "skip the studies whose results the folder has");
  command->add_option("--out", runs.folder, "folder of the results; default: bench/results/MACHINE");
  command->add_option("--report", report_folder, "folder of the reports")->capture_default_str();
  command->add_flag("--strict", runs.strict, strict_help);
  return command;
}

/// A study repeats its measurements by itself, so one run is enough.
std::vector<MeasuredWork> every_study(const std::string& report_folder) {
  std::vector<MeasuredWork> work;
  for (const Study& study : all_studies())
    work.push_back({ResultKind::study, study.name, {study.name, "--out", report_folder}, 1});
  return work;
}

int run(int argc, char** argv) {
  CLI::App app("Studies of Scree: many measurements, and a report of each study", "scree-studies");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  const CLI::App* list_command = app.add_subcommand("list", "name every study");
  StudyRun study{.quick = false, .folder = "out/report", .json_file = {}, .strict = false};
  std::vector<const CLI::App*> study_commands;
  for (const Study& row : all_studies()) study_commands.push_back(add_study(app, row, study));
  AllRuns all;
  std::string report_folder = "out/report";
  add_all(app, all, report_folder);
  for (CLI::App* command : app.get_subcommands({})) refuse_empty(*command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  if (list_command->parsed()) return list();
  for (size_t i = 0; i < study_commands.size(); ++i)
    if (study_commands[i]->parsed()) return run_study(all_studies()[i], study);
  return run_all(every_study(report_folder), all);
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  return scree::run(argc, argv);
}
