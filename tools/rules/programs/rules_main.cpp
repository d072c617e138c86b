// scree-rules: for makers of rules. A folder to begin with, checks, tests, types for editors, the reference.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "tools/rules/check_folder.h"
#include "tools/rules/new_folder.h"
#include "tools/rules/reference_text.h"
#include "tools/rules/test_report.h"
#include "tools/rules/types_text.h"

namespace scree {
namespace {

constexpr int exit_found = 1;  ///< faults, or tests that failed
constexpr int exit_error = 2;  ///< it could not look, or the command line is wrong

struct Options {
  std::string name;
  std::vector<std::string> folders;
  RulesTestOptions test;
  std::string types_folder = ".";
  bool json = false;
};

int refuse(const Error& error) {
  std::fprintf(stderr, "scree-rules: %s\n", error.message.c_str());
  return exit_error;
}

int make(const Options& options) {
  if (const auto made = make_rules_folder(options.name); !made) return refuse(made.error());
  std::printf("%s is there: init.lua is its rules, tests/first.lua their tests.\n", options.name.c_str());
  std::printf("  ./scree rules test %s\n  ./scree server --rules %s --rules-watch\n", options.name.c_str(),
              options.name.c_str());
  return 0;
}

nlohmann::ordered_json json_of(const std::string& folder, const FolderFault& fault) {
  nlohmann::ordered_json json{{"folder", folder}, {"file", fault.file}};
  if (fault.line != 0) json["line"] = fault.line;
  if (fault.column != 0) json["column"] = fault.column;
  json["fault"] = fault.words;
  return json;
}

void print(const std::string& folder, const FolderFault& fault) {
  const std::string line = fault.line != 0 ? std::to_string(fault.line) + ":" : "";
  const std::string column = fault.column != 0 ? std::to_string(fault.column) + ":" : "";
  const std::string place = fault.file.empty() ? "" : "/" + fault.file;
  std::printf("%s%s:%s%s %s\n", folder.c_str(), place.c_str(), line.c_str(), column.c_str(),
              fault.words.c_str());
}

int check(const Options& options) {
  auto all = nlohmann::ordered_json::array();
  size_t count = 0;
  for (const std::string& folder : options.folders) {
    const auto faults = check_folder(folder);
    if (!faults) return refuse(faults.error());
    count += faults->size();
    for (const FolderFault& fault : *faults)
      if (options.json)
        all.push_back(json_of(folder, fault));
      else
        print(folder, fault);
  }
  if (options.json)
    std::printf("%s\n", nlohmann::ordered_json{{"faults", all}}.dump(2).c_str());
  else if (count == 0)
    std::printf("no faults\n");
  return count == 0 ? 0 : exit_found;
}

int test(const Options& options) {
  const auto passed = run_rules_tests(options.test);
  if (!passed) return refuse(passed.error());
  return *passed ? 0 : exit_found;
}

int types(const Options& options) {
  if (const auto written = write_types(options.types_folder); !written) return refuse(written.error());
  std::printf("%s/types and .luarc.json are written\n", options.types_folder.c_str());
  return 0;
}

int reference() {
  std::fputs(reference_text().c_str(), stdout);
  return 0;
}

int run(CLI::App& app, int argc, char** argv) {
  Options options;
  int status = 0;
  app.require_subcommand(1);
  CLI::App* const made = app.add_subcommand("new", "makes a folder of rules that runs");
  made->add_option("NAME", options.name, "the new folder")->required();
  made->callback([&] { status = make(options); });
  CLI::App* const checked = app.add_subcommand("check", "finds wrong syntax and unknown names");
  checked->add_option("FOLDER", options.folders, "with init.lua; repeatable")->required();
  checked->add_flag("--json", options.json, "prints JSON");
  checked->callback([&] { status = check(options); });
  CLI::App* const tested = app.add_subcommand("test", "runs the tests of a folder, without a server");
  tested->add_option("FOLDER", options.test.folder, "with init.lua and tests/")->required();
  tested->add_option("FILTER", options.test.filter, "runs the tests whose names contain this text");
  tested->add_flag("--log", options.test.log, "prints what the rules say and print in tests that pass, too");
  tested->add_flag("--json", options.test.json, "prints JSON");
  tested->callback([&] { status = test(options); });
  CLI::App* const typed = app.add_subcommand("types", "writes what editors need to know all functions");
  typed->add_option("--out", options.types_folder, "the folder of the rules")->capture_default_str();
  typed->callback([&] { status = types(options); });
  app.add_subcommand("reference", "prints all events and functions as Markdown")->callback([&] {
    status = reference();
  });
  refuse_empty(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_error;
  }
  return status;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  CLI::App app("Makes, checks and tests rules of a game in Lua.", "scree-rules");
  app.set_version_flag("--version", SCREE_VERSION);
  const int status = scree::run(app, argc, argv);
  const auto flushed = scree::flush_output();
  if (flushed) return status;
  std::fprintf(stderr, "scree-rules: %s\n", flushed.error().message.c_str());
  return scree::exit_error;
}
