// A file of a folder's tests: Lua in a machine of its own, which makes worlds with the folder's rules, lets
// persons act in them, and says what it expects (docs/rules.md, Tests).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/sandbox/script.h"
#include "tools/rules/test_world.h"

namespace scree {

/// What became of a test.
struct TestOutcome {
  std::string file;       ///< "tests/first.lua"
  std::string name{};     ///< as the file says it; empty: the file itself could not be run
  std::string failure{};  ///< "tests/first.lua:12: 3 is not 4", and more lines; empty: it passed
  double seconds = 0.0;
  Tick ticks = 0;                  ///< of all its worlds
  std::vector<std::string> log{};  ///< of the rules
};

/// A function of a test's own object: t:NAME(…).
class TestCall;
struct TestFunction {
  std::string_view name;
  std::string_view arguments;  ///< as in server/rules/api.h
  std::string_view returns;
  std::string_view what;
  Result<void> (*run)(TestCall& call) = nullptr;
};

/// Functions by part; the rest of what tests find is Lua (test_prelude.cpp).
std::span<const TestFunction> test_world_functions();   ///< the world, time, the rules
std::span<const TestFunction> test_person_functions();  ///< persons and what they see
/// What the prelude of tests has beside them, to be explained alone: their `run` is null.
std::span<const TestFunction> test_lua_functions();  ///< t:until_true, …
std::span<const TestFunction> test_globals();        ///< test, expect, …
/// Kinds of requests that tests ask for by t:KIND(person, fields), and by t:request(person, kind, fields).
std::vector<std::string_view> test_request_kinds();
std::string_view test_prelude();

/// What the functions of a running test share.
struct RunningTest {
  std::string folder;                ///< of the rules
  std::unique_ptr<TestWorld> world;  ///< null: none was made yet
  Tick ticks = 0;                    ///< of worlds before
  bool faults_asked = false;         ///< so it expects some
};

class TestCall {
 public:
  TestCall(RunningTest& test, ScriptCall& call) : test_(test), call_(call) {}

  RunningTest& test() const { return test_; }
  /// The world, which is made as usual where the test made none.
  Result<TestWorld*> world() const;
  ScriptWriter& results() const { return call_.results(); }
  /// Counts from 1, without the test's object.
  ScriptValue argument(int number, std::string_view name) const { return call_.argument(number + 1, name); }
  /// The session of somebody who is here.
  Result<uint64_t> person(int number) const;

 private:
  RunningTest& test_;
  ScriptCall& call_;
};

/// Makes the world that a table of t:world describes, and lets the rules begin in it.
Result<void> make_world(RunningTest& test, const ScriptValue* options);

/// Binds what the files of tests find.
Result<Script> make_test_script(const std::string& folder, RunningTest& test,
                                std::function<void(ScriptCall& call)> add_test,
                                std::function<void(std::string_view line)> print);

/// Runs the tests of a file whose names contain `filter`. `told` gets each outcome at once.
void run_test_file(const std::string& folder, const std::string& file, const std::string& filter,
                   const std::function<void(const TestOutcome&)>& told);

/// The files of a folder's tests, in order: "tests/first.lua".
Result<std::vector<std::string>> test_files(const std::string& folder);

}  // namespace scree
