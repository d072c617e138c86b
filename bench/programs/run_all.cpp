#include "bench/programs/run_all.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <vector>

#include "bench/programs/exit_codes.h"
#include "bench/programs/print_result.h"
#include "bench/results/result_file.h"

extern char** environ;

namespace scree {

namespace {

/// Runs this program with the arguments, in the same terminal; says how it ended where that was not well.
std::optional<std::string> run_myself(const std::vector<std::string>& arguments) {
  std::vector<std::string> texts{program_invocation_short_name};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  std::fflush(stdout);
  const int error = posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, pointers.data(), environ);
  if (error != 0) return std::string("cannot be started: ") + std::strerror(error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return std::string("cannot be waited for: ") + std::strerror(errno);
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) != exit_done) return fmt::format("ended with status {}", WEXITSTATUS(status));
  return std::nullopt;
}

std::vector<std::string> arguments_of(const MeasuredWork& work, const AllRuns& runs,
                                      const std::string& file) {
  std::vector<std::string> arguments = work.arguments;
  arguments.insert(arguments.end(), {"--json", file});
  if (runs.quick) arguments.emplace_back("--quick");
  return arguments;
}

bool is_there(const MeasuredWork& work, const AllRuns& runs, const std::string& file) {
  const Result<StoredResult> result = read_result(file);
  return result && result->kind == work.kind && result->name == work.name &&
         result->options == asked_options({.quick = runs.quick}) && result->runs >= work.runs;
}

/// How a piece of work came out; the result is missing where it failed.
struct Outcome {
  MeasuredWork work;
  double seconds = 0.0;
  std::optional<StoredResult> result{};
  std::string failure{};
};

Outcome carry_out(const MeasuredWork& work, const AllRuns& runs, const std::string& file) {
  Outcome outcome{.work = work};
  const auto began = std::chrono::steady_clock::now();
  if (!(runs.resume && is_there(work, runs, file)))
    if (const auto failure = run_myself(arguments_of(work, runs, file))) outcome.failure = *failure;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!outcome.failure.empty()) return outcome;
  Result<StoredResult> result = read_result(file);
  if (result)
    outcome.result = std::move(*result);
  else
    outcome.failure = result.error().message;
  return outcome;
}

void print_summary(const std::vector<Outcome>& outcomes, const std::string& folder) {
  std::printf("\n%-12s %9s  %-10s %s\n", "name", "seconds", "checks", "missed");
  for (const Outcome& outcome : outcomes) {
    if (!outcome.result) {
      std::printf("%-12s %9.1f  FAILED     %s\n", outcome.work.name.c_str(), outcome.seconds,
                  outcome.failure.c_str());
      continue;
    }
    const auto& checks = outcome.result->checks;
    const size_t missed = outcome.result->missed();
    std::string names;
    for (const auto& [name, check] : checks)
      if (!check.passed) names += (names.empty() ? "" : ", ") + name;
    const std::string passed = fmt::format("{} of {}", checks.size() - missed, checks.size());
    std::printf("%-12s %9.1f  %-10s %s\n", outcome.work.name.c_str(), outcome.seconds, passed.c_str(),
                names.c_str());
  }
  std::printf("results: %s\n", folder.c_str());
}

}  // namespace

std::string results_folder() {
  return "bench/results/" + slug_of(this_machine());
}

int run_all(const std::vector<MeasuredWork>& work, const AllRuns& runs) {
  const std::string folder = runs.folder.empty() ? results_folder() : runs.folder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    std::fprintf(stderr, "%s: %s\n", folder.c_str(), error.message().c_str());
    return exit_not_done;
  }
  std::vector<Outcome> outcomes;
  bool failed = false, missed = false;
  for (const MeasuredWork& next : work) {
    std::printf("[%zu of %zu] %s\n", outcomes.size() + 1, work.size(), next.name.c_str());
    outcomes.push_back(carry_out(next, runs, folder + "/" + next.name + ".json"));
    const Outcome& outcome = outcomes.back();
    failed = failed || !outcome.result;
    missed = missed || (outcome.result && outcome.result->missed() > 0);
  }
  print_summary(outcomes, folder);
  if (failed) return exit_not_done;
  return runs.strict && missed ? exit_worse : exit_done;
}

}  // namespace scree
