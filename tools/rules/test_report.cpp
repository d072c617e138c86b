#include "tools/rules/test_report.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/rules/api_words.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

constexpr size_t log_lines_shown = 10;

void print_outcome(const TestOutcome& outcome, bool all_lines) {
  const bool passed = outcome.failure.empty();
  if (passed)
    fmt::print("  ok      {} ({} ticks, {:.2f} s)\n", outcome.name, outcome.ticks, outcome.seconds);
  else
    fmt::print("  FAILED  {}\n          {}\n", outcome.name.empty() ? outcome.file : outcome.name,
               indented(outcome.failure, "          "));
  const size_t lines = outcome.log.size();
  const size_t shown = all_lines ? lines : passed ? 0 : std::min(lines, log_lines_shown);
  for (size_t i = lines - shown; i < lines; ++i)
    fmt::print("          said: {}\n", indented(outcome.log[i], "          "));
  std::fflush(stdout);
}

nlohmann::ordered_json json_of(const TestOutcome& outcome, bool with_log) {
  nlohmann::ordered_json json{{"file", outcome.file},
                              {"name", outcome.name},
                              {"passed", outcome.failure.empty()},
                              {"ticks", outcome.ticks},
                              {"seconds", outcome.seconds}};
  if (!outcome.failure.empty()) json["failure"] = outcome.failure;
  if (with_log || !outcome.failure.empty()) json["log"] = outcome.log;
  return json;
}

}  // namespace

Result<bool> run_rules_tests(const RulesTestOptions& options) {
  size_t passed = 0, failed = 0;
  auto tests = nlohmann::ordered_json::array();
  for (const std::string& file : TRY(test_files(options.folder))) {
    if (!options.json) fmt::print("{}/{}\n", options.folder, file);
    run_test_file(options.folder, file, options.filter, [&](const TestOutcome& outcome) {
      ++(outcome.failure.empty() ? passed : failed);
      if (options.json)
        tests.push_back(json_of(outcome, options.log));
      else
        print_outcome(outcome, options.log);
    });
  }
  if (options.json)
    fmt::print("{}\n", nlohmann::ordered_json{{"passed", passed}, {"failed", failed}, {"tests", tests}}.dump(
                           2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    fmt::print("{} passed, {} failed\n", passed, failed);
  if (passed + failed == 0)
    return fail("no test of " + options.folder + " has '" + options.filter + "' in its name");
  return failed == 0;
}

}  // namespace scree
