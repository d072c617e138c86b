// Why a call of a script ended before its end, and what calls may use.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scree {

struct ScriptFault {
  enum class Kind : uint8_t {
    error,          ///< an error of the script: of its syntax, of its own making, or of a bound function
    too_long,       ///< the budget of work or the time of a call is spent
    out_of_memory,  ///< the script holds more than its memory_max_bytes; what it no longer needs is freed
                    ///< then
  };
  Kind kind = Kind::error;
  /// Begins with "file:line: " where the place is known; files are named as in the script's folder.
  std::string message;
  /// "file:line: in function 'name'", innermost first; at most script_traceback_lines_max.
  std::vector<std::string> traceback;

  /// The message, and the traceback in lines below it.
  std::string text() const;
};

/// What calls may still use. Several calls share one: each takes off what it used. A call begins only where
/// both are above 0, and may end up to a few ms below.
struct ScriptBudget {
  /// Units of work: about one for an instruction of Lua's machine, 12 for a new value on the heap, and one
  /// for 16 bytes that are granted or that a function of the library touches. A unit takes 5 to 20 ns.
  int64_t work = 0;
  /// Seconds of processor time of the calling thread: a backstop for work that is dearer than it counts.
  double cpu_s = 0;
};

}  // namespace scree
