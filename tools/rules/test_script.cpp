#include "tools/rules/test_script.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "server/rules/prelude.h"
#include "server/rules/values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// What a test may use: an endless loop ends after some seconds; worlds that are stepped may take long.
constexpr int64_t test_work_max = 400'000'000;
constexpr double test_cpu_max_s = 600.0;
constexpr size_t test_memory_bytes = size_t{64} << 20U;

struct NamedTest {
  std::string name;
  ScriptFunction body;
};

ScriptBudget whole_budget() {
  return {test_work_max, test_cpu_max_s};
}

/// The session of a handle, as a number that people read.
Result<void> number_of_handle(ScriptCall& call, std::string_view type) {
  call.results().integer(static_cast<int64_t>(TRY(call.argument(1, type).handle(type))));
  return {};
}

/// Types of handles are there once they have a method.
void define_handles(Script& script) {
  for (const std::string_view type : {person_type, body_type, joint_type})
    script.define_method(type, "number", [type](ScriptCall& call) { return number_of_handle(call, type); });
}

/// Runs a body; the failure, or an empty text.
std::string run_body(Script& script, const ScriptFunction& body, RunningTest& test) {
  ScriptBudget budget = whole_budget();
  const ScriptFunction runner = script.global_function("run_a_test");
  CHECK(static_cast<bool>(runner));
  const auto ended = script.call(
      runner, [&](ScriptWriter& to) { to.function(body); }, budget);
  if (!ended) return ended.error().message;
  if (test.world == nullptr) return {};
  if (!test.faults_asked && test.world->faults() != 0)
    return std::to_string(test.world->faults()) + " calls of the rules failed: t:faults() would expect that";
  if (const MassUnits error = test.world->ledger_error(); error != 0)
    return "mass is lost or made: t:ledger_error() is " + std::to_string(error);
  return {};
}

}  // namespace

Result<TestWorld*> TestCall::world() const {
  if (test_.world == nullptr) TRY(make_world(test_, nullptr));
  return test_.world.get();
}

Result<uint64_t> TestCall::person(int number) const {
  const ScriptValue value = argument(number, "person");
  const uint64_t session = TRY(value.handle(person_type));
  const TestPerson* const person = TRY(world())->person(session);
  if (person == nullptr || !person->here) return fail("the person is not here, or not any more");
  return session;
}

Result<Script> make_test_script(const std::string& folder, RunningTest& test,
                                std::function<void(ScriptCall& call)> add_test,
                                std::function<void(std::string_view line)> print) {
  Script script = TRY(Script::create({.name = "tests",
                                      .folder = folder,
                                      .memory_max_bytes = test_memory_bytes,
                                      .work_max = test_work_max,
                                      .cpu_max_s = test_cpu_max_s,
                                      .print = std::move(print)}));
  for (const auto part : {test_world_functions(), test_person_functions()})
    for (const TestFunction& row : part)
      script.define("stage", row.name, [&test, run = row.run](ScriptCall& call) -> Result<void> {
        TestCall bound(test, call);
        return run(bound);
      });
  define_handles(script);
  script.define("", "test", [add_test = std::move(add_test)](ScriptCall& call) -> Result<void> {
    TRY(call.argument(1, "name").text());
    TRY(call.argument(2, "body").function());
    add_test(call);
    return {};
  });
  ScriptBudget budget = whole_budget();
  if (const auto loaded = load_prelude(script, budget); !loaded) return fail(loaded.error().text());
  if (const auto loaded = script.load_text("tests", test_prelude(), budget); !loaded)
    return fail(loaded.error().text());
  return script;
}

void run_test_file(const std::string& folder, const std::string& file, const std::string& filter,
                   const std::function<void(const TestOutcome&)>& told) {
  std::vector<NamedTest> tests;
  RunningTest test{.folder = folder, .world = nullptr};
  std::vector<std::string> printed;
  const auto add_test = [&](ScriptCall& call) {
    tests.push_back({std::string(*call.argument(1, "name").text()), *call.argument(2, "body").function()});
  };
  auto script =
      make_test_script(folder, test, add_test, [&](std::string_view line) { printed.emplace_back(line); });
  if (!script) return told({.file = file, .failure = script.error().message});
  ScriptBudget budget = whole_budget();
  if (const auto loaded = script->load(file, budget); !loaded)
    return told({.file = file, .failure = loaded.error().message});
  for (const NamedTest& one : tests) {
    if (one.name.find(filter) == std::string::npos) continue;
    const auto began = std::chrono::steady_clock::now();
    test = {.folder = folder, .world = nullptr};
    TestOutcome outcome{.file = file, .name = one.name};
    outcome.failure = run_body(*script, one.body, test);
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    outcome.ticks = test.ticks + (test.world != nullptr ? test.world->tick() : 0);
    if (test.world != nullptr) outcome.log = test.world->log();
    outcome.log.insert(outcome.log.end(), printed.begin(), printed.end());
    printed.clear();
    told(outcome);
  }
}

Result<std::vector<std::string>> test_files(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> files;
  for (fs::directory_iterator at(fs::path(folder) / "tests", error), end; !error && at != end;
       at.increment(error))
    if (at->path().extension() == ".lua") files.push_back("tests/" + at->path().filename().string());
  std::ranges::sort(files);
  if (files.empty()) return fail(folder + ": there are no tests: they are files tests/NAME.lua");
  return files;
}

}  // namespace scree
