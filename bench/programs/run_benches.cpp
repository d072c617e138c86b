#include "bench/programs/run_benches.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

#include "bench/programs/exit_codes.h"
#include "bench/programs/print_result.h"
#include "bench/support/benches.h"
#include "bench/support/scratch.h"
#include "shared/base/option_check.h"
#include "shared/base/progress_bar.h"
#include "tools/scenes/scene.h"

namespace scree {

namespace {

/// Whether the options are the bench's; says so if not.
bool takes(const Bench& bench, const BenchRuns& runs) {
  const BenchOptions& options = runs.options;
  const bool any =
      !options.part.empty() || !options.folder.empty() || options.world_mb || options.memory_max_mb;
  if (bench.parts.empty() && any)
    std::fprintf(stderr,
                 "'%s' has no parts, so it does not accept --part, --folder, --world-mb or --memory-max\n",
                 bench.name.c_str());
  else if (!runs.scene.empty() && !bench.takes_scene)
    std::fprintf(stderr, "'%s' takes no scene; `bench list` names those that do\n", bench.name.c_str());
  else if (!options.part.empty() && std::ranges::find(bench.parts, options.part) == bench.parts.end())
    std::fprintf(stderr, "'%s' has no part '%s'; `bench list` names them\n", bench.name.c_str(),
                 options.part.c_str());
  else
    return true;
  return false;
}

/// The benches of those names; none when one of them cannot be run so.
std::vector<const Bench*> chosen_benches(const BenchRuns& runs) {
  std::vector<const Bench*> chosen;
  for (const std::string& name : runs.names) {
    const auto bench = std::ranges::find(all_benches(), name, &Bench::name);
    if (bench == all_benches().end()) {
      std::fprintf(stderr, "there is no bench '%s'; `bench list` names them\n", name.c_str());
      return {};
    }
    if (!takes(*bench, runs)) return {};
    if (std::ranges::find(chosen, &*bench) == chosen.end()) chosen.push_back(&*bench);
  }
  return chosen;
}

}  // namespace

int run_benches(const BenchRuns& runs) {
  const std::vector<const Bench*> benches = chosen_benches(runs);
  if (benches.empty()) return exit_usage;
  if (benches.size() > 1 && !runs.json_file.empty()) {
    std::fprintf(stderr, "--json is for one bench; --out DIR writes a file for each\n");
    return exit_usage;
  }
  const ScratchFolder folder("scene");
  BenchOptions options = runs.options;
  if (!runs.scene.empty()) {
    const Result<SceneSetup> scene = scene_named(runs.scene)->set_up(folder / "");
    if (!scene) {
      std::fprintf(stderr, "scree-bench: scene %s: %s\n", runs.scene.c_str(), scene.error().message.c_str());
      return exit_not_done;
    }
    options.scene = std::make_shared<const SceneSetup>(*scene);
  }
  std::vector<std::vector<BenchReport>> reports(benches.size());
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  double done = 0.0;
  const double all = static_cast<double>(runs.repeat) * static_cast<double>(benches.size());
  options.progress = [&](double part) { bar.show((done + part) / all); };
  for (uint32_t round = 0; round < runs.repeat; ++round)
    for (size_t i = 0; i < benches.size(); ++i, done += 1.0) reports[i].push_back(benches[i]->run(options));
  bar.end();
  bool written = true;
  size_t missed = 0;
  for (size_t i = 0; i < benches.size(); ++i) {
    StoredResult result = summarised(ResultKind::bench, benches[i]->name, reports[i]);
    result.options = asked_options(runs.options);
    if (!runs.scene.empty()) result.options["scene"] = runs.scene;
    result.machine = this_machine();
    print_result(benches[i]->summary, reports[i].front(), result);
    missed += result.missed();
    if (!runs.json_file.empty()) written = write_stored(result, runs.json_file) && written;
    if (!runs.folder.empty())
      written = write_stored(result, runs.folder + "/" + result.name + ".json") && written;
  }
  if (!written) return exit_not_done;
  return runs.strict && missed > 0 ? exit_worse : exit_done;
}

}  // namespace scree
