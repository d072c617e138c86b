// A mod's rules: Lua 5.4 in a sandbox. A Script is one machine of Lua with memory of its own; it reaches
// nothing but what its host binds. Whatever the text of a script does, a call ends within its budget (a few
// ms over at most), memory stays within its limit (a quarter over at most), and the process goes on. What a
// script finds in there, and what differs from stock Lua, is in library.h.
//
// Thread: one at a time; a Script may change threads between calls. Calls do not nest: a bound function must
// not call its script.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/sandbox/script_fault.h"
#include "server/rules/sandbox/script_value.h"
#include "shared/base/result.h"

namespace scree {

struct ScriptState;

struct ScriptOptions {
  /// Names the script in messages.
  std::string name;
  /// Where load() and require() find files; without one there is no require().
  std::filesystem::path folder;
  /// Bytes that the script's values may take in all; within script_memory_*_bytes (script_limits.h).
  size_t memory_max_bytes = size_t{16} << 20U;
  /// What any one call may use, whatever is left of its budget.
  int64_t work_max = 10'000'000;
  double cpu_max_s = 0.25;
  /// Gets each print(), without a line's end; showable text of at most script_print_bytes_max. May be empty.
  std::function<void(std::string_view line)> print;
  uint64_t random_seed = 0;
};

/// A call of a bound function: its arguments, and what it returns.
class ScriptCall {
 public:
  /// Arguments count from 1, and `name` is for refusals. One that is missing is nil.
  ScriptValue argument(int number, std::string_view name) const;
  int arguments() const;
  /// Takes what the function writes, in order, as its results.
  ScriptWriter& results() { return results_; }
  /// Adds to the work of the running call: what the function did, in the units of ScriptBudget. True where
  /// the budget is spent: the function may stop early, and the script ends when it returns.
  bool charge(int64_t work);

 private:
  friend struct BoundCall;
  ScriptCall(ScriptState& state, lua_State* lua);

  ScriptState& state_;
  lua_State* lua_;
  int arguments_;
  ScriptWriter results_;
};

/// An error becomes one of the script, with the place of the call before it. Must not throw.
using BoundFunction = std::function<Result<void>(ScriptCall& call)>;

class Script {
 public:
  /// Refuses limits that are out of range, and a folder that is none.
  static Result<Script> create(ScriptOptions options);
  Script(Script&&) noexcept;
  Script& operator=(Script&&) noexcept;
  ~Script();

  /// Binds a function into a global table, "world", which is made with the first; "" for the globals
  /// themselves. Between calls. Scripts cannot change bound tables.
  void define(std::string_view table, std::string_view name, BoundFunction function);
  /// Makes a type of handles and binds a function as its method: `person:tell("…")` calls `tell` with the
  /// handle as argument 1. Handles of the same type and number are equal, and one key of tables.
  void define_method(std::string_view type, std::string_view name, BoundFunction function);
  /// Puts constants into a global table: `write` writes its values, each after a name().
  void define_values(std::string_view table, const std::function<void(ScriptWriter& to)>& write);

  /// The table that a global variable holds becomes the metatable of what ScriptWriter::vector() writes, and
  /// the variable goes. Between calls, after the host's own text that made it. It must have a __metatable:
  /// what a script can reach may get a finalizer, which no budget watches.
  void take_vectors(std::string_view global);

  using Ended = tl::expected<void, ScriptFault>;
  /// Runs a file of the folder, "main.lua", or a text named `chunk` in messages.
  Ended load(std::string_view path, ScriptBudget& budget);
  Ended load_text(std::string_view chunk, std::string_view text, ScriptBudget& budget);

  /// The function that a global variable holds; an empty one where it holds none.
  ScriptFunction global_function(std::string_view name);

  using WriteArguments = std::function<void(ScriptWriter& arguments)>;
  /// Results count from 1. An error is that of the call.
  using ReadResults = std::function<Result<void>(const std::vector<ScriptValue>& results)>;
  Ended call(const ScriptFunction& function, const WriteArguments& arguments, ScriptBudget& budget,
             const ReadResults& results = nullptr);

  /// A line of a console: an expression or statements. Its values as people read them, separated by tabs.
  tl::expected<std::string, ScriptFault> run(std::string_view line, ScriptBudget& budget);

  /// What math.random() begins with from now on.
  void seed(uint64_t random_seed);

  struct Used {
    int64_t work = 0;  ///< of all calls
    double cpu_s = 0;
    size_t memory_bytes = 0;       ///< now
    size_t memory_most_bytes = 0;  ///< ever
  };
  Used used() const;
  const std::string& name() const;

 private:
  explicit Script(std::unique_ptr<ScriptState> state);
  std::unique_ptr<ScriptState> state_;
};

}  // namespace scree
