// A script, texts for it, and what became of them.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/sandbox/script.h"
#include "shared/base/timing.h"

namespace scree {

/// What tests give: 8 MiB, and a million units of work a call.
inline ScriptOptions small_options() {
  ScriptOptions options;
  options.name = "test";
  options.memory_max_bytes = size_t{8} << 20U;
  options.work_max = 1'000'000;
  options.cpu_max_s = 60;  // tests go by work: machines differ
  return options;
}

/// A script and the lines that it printed.
class Played {
 public:
  explicit Played(ScriptOptions options = small_options()) : script(make(std::move(options), lines)) {}

  Script::Ended run(std::string_view text) {
    ScriptBudget budget{1'000'000'000, 60};
    return script.load_text("test", text, budget);
  }

  /// What a console shows, or the fault's text after "! ".
  std::string ask(std::string_view line) {
    ScriptBudget budget{1'000'000'000, 60};
    const auto shown = script.run(line, budget);
    return shown ? *shown : "! " + shown.error().message;
  }

  std::vector<std::string> lines;
  Script script;

 private:
  static Script make(ScriptOptions options, std::vector<std::string>& lines) {
    options.print = [&lines](std::string_view line) { lines.emplace_back(line); };
    return *Script::create(std::move(options));
  }
};

/// The text that a chunk returns, whole; "error: " and the message where it raises one.
inline std::string returned(Played& played, const std::string& text) {
  std::string result;
  ScriptBudget budget{1'000'000'000, 60};
  const auto loaded = played.run("function main() " + text + "\nend");
  if (!loaded) return "error: " + loaded.error().message;
  const auto ended = played.script.call(played.script.global_function("main"), nullptr, budget,
                                        [&](const std::vector<ScriptValue>& results) -> Result<void> {
                                          result = std::string(TRY(results.at(0).text()));
                                          return {};
                                        });
  return ended ? result : "error: " + ended.error().message;
}

/// Runs a text that must not come to its end.
inline ScriptFault fault_of(Played& played, std::string_view text) {
  const Script::Ended ended = played.run(text);
  if (ended) {
    ADD_FAILURE() << "it came to its end: " << text;
    return {};
  }
  return ended.error();
}

}  // namespace scree
