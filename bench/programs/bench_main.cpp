// scree-bench: runs benchmarks and compares their results. Tables for people, JSON for
// programs. Exit status: 0 done, 1 something could not be done, 2 wrong usage, 3 a check was missed (with
// --strict) or a comparison found something worse (with --strict: or gone).
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/programs/compare_files.h"
#include "bench/programs/exit_codes.h"
#include "bench/programs/run_all.h"
#include "bench/programs/run_benches.h"
#include "bench/support/benches.h"
#include "shared/base/option_check.h"
#include "tools/scenes/scene.h"

namespace scree {
namespace {

constexpr const char* strict_help = "exit with status 3 if a check fails";
constexpr const char* quick_help = "run fewer rounds, only to see that it runs";
constexpr double repeat_max = 100.0;

int list() {
  for (const Bench& bench : all_benches()) {
    std::printf("%-12s %s\n", bench.name.c_str(), bench.summary.c_str());
    for (const std::string& part : bench.parts) std::printf("%-12s   --part %s\n", "", part.c_str());
    if (bench.takes_scene) std::printf("%-12s   --scene NAME\n", "");
  }
  return exit_done;
}

CLI::App* add_run(CLI::App& app, BenchRuns& runs) {
  CLI::App* command = app.add_subcommand("run", "run benchmarks");
  BenchOptions& options = runs.options;
  command->add_option("name", runs.names, "names of benchmarks (see list); with --repeat they take turns")
      ->required();
  command->add_flag("--quick", options.quick, quick_help);
  bounded(command->add_option("--repeat", runs.repeat,
                              "runs of each benchmark; figures are the median, minimum and maximum"),
          whole_within(1.0, repeat_max));
  bounded(command->add_option("--minutes", options.minutes,
                              "length of the session in minutes, for benchmarks that have one"),
          {0.0, 600.0});
  command->add_option("--json", runs.json_file, "write the result of one bench to this file")
      ->check(check_writable, "FILE");
  command->add_option("--out", runs.folder, "write each result to NAME.json in this folder");
  command->add_flag("--strict", runs.strict, strict_help);
  command
      ->add_option("--scene", runs.scene,
                   "use this scene instead of the benchmark's own ground: " + scene_names())
      ->check([](const std::string& name) {
        return scene_named(name) == nullptr
                   ? "there is no scene '" + name + "'; the scenes are " + scene_names()
                   : "";
      });
  command->add_option("--part", options.part, "run only this part of the benchmark (see list)");
  command->add_option("--folder", options.folder,
                      "folder that keeps worlds for later runs, because they take long to make");
  command->add_option("--world-mb", options.world_mb, "size of the world in which clients move, MiB")
      ->check(CLI::Range(16U, 16384U));
  command->add_option("--memory-max", options.memory_max_mb, "memory-max of the benchmark's server, MiB")
      ->check(CLI::Range(256U, 65536U));
  return command;
}

CLI::App* add_all(CLI::App& app, AllRuns& runs, uint32_t& repeat) {
  CLI::App* command = app.add_subcommand("all",
                                         "run every benchmark, each in a process of its own, and keep the "
                                         "results by machine");
  command->add_flag("--quick", runs.quick, quick_help);
  bounded(command->add_option("--repeat", repeat, "runs of each benchmark"), whole_within(1.0, repeat_max));
  command->add_flag("--resume", runs.resume, "skip the benchmarks whose results the folder has");
  command->add_option("--out", runs.folder, "folder of the results; default: bench/results/MACHINE");
  command->add_flag("--strict", runs.strict, strict_help);
  return command;
}

std::vector<MeasuredWork> every_bench(uint32_t repeat) {
  std::vector<MeasuredWork> work;
  for (const Bench& bench : all_benches())
    work.push_back(
        {ResultKind::bench, bench.name, {"run", bench.name, "--repeat", std::to_string(repeat)}, repeat});
  return work;
}

int run(int argc, char** argv) {
  CLI::App app("Benchmarks of Scree", "scree-bench");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  app.add_subcommand("list", "name every benchmark");
  BenchRuns benches;
  const CLI::App* run_command = add_run(app, benches);
  AllRuns all;
  uint32_t repeat = 1;
  const CLI::App* all_command = add_all(app, all, repeat);
  CLI::App* compare = app.add_subcommand(
      "compare",
      "list what became better or worse between two results; exit with status 3 if something is worse");
  ComparedFiles compared;
  compare->add_option("before", compared.before, "a result, or a folder of results")
      ->required()
      ->check(CLI::ExistingPath);
  compare->add_option("after", compared.after, "another result, or another folder of results")
      ->required()
      ->check(CLI::ExistingPath);
  compare->add_flag("--strict", compared.strict,
                    "exit with status 3 also if a metric, a check or a result is missing in the second one");
  for (CLI::App* command : app.get_subcommands({})) refuse_empty(*command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  if (run_command->parsed()) return run_benches(benches);
  if (all_command->parsed()) return run_all(every_bench(repeat), all);
  if (compare->parsed()) return compare_files(compared);
  return list();
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  return scree::run(argc, argv);
}
