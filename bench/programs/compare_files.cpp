#include "bench/programs/compare_files.h"

#include <cstdio>
#include <filesystem>

#include "bench/programs/exit_codes.h"
#include "bench/results/comparison.h"
#include "bench/results/result_file.h"

namespace scree {

namespace {

using Results = std::map<std::string, StoredResult>;

int complain(const std::string& message) {
  std::fprintf(stderr, "scree-bench: %s\n", message.c_str());
  return exit_not_done;
}

/// By name: a file has one, whatever it is called.
Result<Results> results_at(const std::string& path, bool is_folder) {
  if (is_folder) return read_results(path);
  StoredResult result = TRY(read_result(path));
  return Results{{result.name, std::move(result)}};
}

/// What only one of two folders has; returns how many.
size_t name_lone_ones(const Results& results, const Results& others, const std::string& folder) {
  size_t lone = 0;
  for (const auto& [name, result] : results) {
    if (others.contains(name)) continue;
    ++lone;
    std::printf("%s: only in %s\n", name.c_str(), folder.c_str());
  }
  return lone;
}

/// Prints it; whether it ends the program with exit_worse.
bool tell(const ResultComparison& comparison, bool strict) {
  std::fputs(text_of(comparison).c_str(), stdout);
  return comparison.is_worse() || (strict && comparison.lacks_something());
}

}  // namespace

int compare_files(const ComparedFiles& files) {
  const bool folders = std::filesystem::is_directory(files.before);
  if (folders != std::filesystem::is_directory(files.after)) {
    std::fprintf(stderr, "compare takes two files, or two folders\n");
    return exit_usage;
  }
  const Result<Results> was = results_at(files.before, folders), is = results_at(files.after, folders);
  if (!was) return complain(was.error().message);
  if (!is) return complain(is.error().message);
  if (!folders) {
    const Result<ResultComparison> comparison = compare_results(was->begin()->second, is->begin()->second);
    if (!comparison) return complain(comparison.error().message);
    return tell(*comparison, files.strict) ? exit_worse : exit_done;
  }
  bool worse = false, refused = false, any = false;
  for (const auto& [name, result] : *was) {
    const auto other = is->find(name);
    if (other == is->end()) continue;
    any = true;
    const Result<ResultComparison> comparison = compare_results(result, other->second);
    if (!comparison) {
      complain(comparison.error().message);
      refused = true;
      continue;
    }
    worse = tell(*comparison, files.strict) || worse;
  }
  worse = (name_lone_ones(*was, *is, files.before) > 0 && files.strict) || worse;
  name_lone_ones(*is, *was, files.after);
  if (!any) return complain("the folders have no bench in common");
  if (refused) return exit_not_done;
  return worse ? exit_worse : exit_done;
}

}  // namespace scree
