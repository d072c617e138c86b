// Values on their way between the host and a script. Both classes are views of the script's stack: they are
// valid only during the function that got them.
//
// No function here raises an error of Lua, and none calls code of the script: tables are read and written
// raw, without metamethods. So objects with destructors may live around these calls. While the host has the
// word, memory is granted beyond the script's limit (within script_host_bytes_max), and the script ends with
// out_of_memory when it goes on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

struct lua_State;

namespace scree {

/// A function of a script, kept by the host. Copies name the same function; it may outlive its script. Let go
/// of on any thread that runs the script.
class ScriptFunction {
 public:
  ScriptFunction() = default;
  explicit operator bool() const { return slot_ != nullptr; }

 private:
  friend class Script;
  friend class ScriptValue;
  friend class ScriptWriter;
  std::shared_ptr<const int> slot_;  // of the registry; letting go of the last copy marks it for release
};

/// An object of the host in a script's hands: a type, as Script::define_type() has it, and a number.
struct ScriptHandle {
  std::string_view type;
  uint64_t number = 0;
};

/// Reads one value. Refusals name the value: "argument 2 (radius) is a string, not a number".
class ScriptValue {
 public:
  ScriptValue(lua_State* lua, int index, std::string name);

  bool is_nil() const;  ///< also: no such argument
  bool is_boolean() const;
  bool is_integer() const;  ///< by type: 2.0 is a number, not an integer
  bool is_number() const;   ///< by type: the text "2" is none
  bool is_text() const;
  bool is_table() const;
  bool is_function() const;
  /// "a string", "nil", "a person" (of a handle).
  std::string type_text() const;

  Result<bool> boolean() const;
  Result<int64_t> integer() const;  ///< also a float with an integer's value
  Result<double> number() const;    ///< finite; NaN and infinities are refused
  /// The bytes, as they are; the view lives as long as the value is on the stack or in its table.
  Result<std::string_view> text() const;
  Result<ScriptFunction> function() const;
  Result<uint64_t> handle(std::string_view type) const;

  /// A table's value under a key, nil where there is none; of a value that is no table, an error.
  Result<ScriptValue> field(std::string_view key) const;
  /// A table's item, from 1 to length().
  Result<ScriptValue> item(int64_t index) const;
  Result<int64_t> length() const;
  /// Each pair of a table, in no certain order, until an error. Keys and values are valid in the call alone.
  Result<void> each(
      const std::function<Result<void>(const ScriptValue& key, const ScriptValue& value)>& to) const;

  /// The refusal of a value: "argument 2 (radius) is 9: " and the reason.
  tl::unexpected<Error> refuse(std::string_view reason) const;
  const std::string& name() const { return name_; }

  /// For code beside this folder that knows Lua's interface: raw reads only, and the stack as found.
  lua_State* lua() const { return lua_; }
  int index() const { return index_; }

 private:
  lua_State* lua_;
  int index_;  // absolute
  std::string name_;
};

/// Takes what was read since it was made off the stack again. Values that fields and items gave meanwhile are
/// no longer valid then.
class ReadScope {
 public:
  explicit ReadScope(const ScriptValue& of);
  ~ReadScope();
  ReadScope(const ReadScope&) = delete;
  ReadScope& operator=(const ReadScope&) = delete;

 private:
  lua_State* lua_;
  int top_;
};

/// Writes values, one after another: arguments or results, or, between open_table() and close_table(), what
/// lies in that table. There a value is the next item of a list, or that of the name said just before:
///   to.open_table(); to.name("at"); to.number(1); to.close_table();
class ScriptWriter {
 public:
  explicit ScriptWriter(lua_State* lua);

  void nil();
  void boolean(bool value);
  void integer(int64_t value);
  void number(double value);
  void text(std::string_view value);
  void function(const ScriptFunction& value);
  void handle(const ScriptHandle& value);
  /// A table with the fields x, y and z, and with the metatable that Script::take_vectors() got.
  void vector(double x, double y, double z);
  void open_table();
  void close_table();
  /// The key of the next value; only in a table.
  void name(std::string_view key);
  void key(int64_t key);

  /// A value that the script gave, again.
  void value(const ScriptValue& value);

  /// For code with Lua's interface: the value that it pushed on lua()'s stack is the next one.
  void pushed();
  int count() const { return count_; }  ///< of finished values outside tables
  lua_State* lua() const { return lua_; }

 private:
  struct Level {
    int64_t next = 1;    // item of the list
    bool keyed = false;  // a key waits for its value on the stack
  };

  lua_State* lua_;
  int count_ = 0;
  std::vector<Level> levels_;  // open tables
};

}  // namespace scree
