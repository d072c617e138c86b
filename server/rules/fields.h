// Tables of scripts as values of the host, by the names of their fields. One list of rows says what a table
// has: reading, writing, errors and the reference follow from it. A row that tells kinds apart (`shape`,
// `kind`) comes before those that only some kinds have.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/rules_moment.h"
#include "server/rules/sandbox/script_value.h"
#include "shared/base/result.h"

namespace scree {

struct FieldRow {
  std::string_view name;
  std::string_view type;  ///< in the notation of LuaLS: "vec", "number", "string[]"
  std::string_view what;
  bool needed = false;
  Result<void> (*read)(void* to, const ScriptValue& value, const RulesMoment& moment) = nullptr;
  /// Null: a shorthand of other fields, which are written.
  void (*write)(const void* from, ScriptWriter& to, const RulesMoment& moment) = nullptr;
  bool (*applies)(const void* of) = nullptr;   ///< by the rows before it; null: always
  bool (*is_there)(const void* of) = nullptr;  ///< null: always. Otherwise it is not written
};

/// Which fields a table had.
class GivenFields {
 public:
  bool has(std::string_view name) const;
  void add(std::string_view name) { names_.push_back(name); }
  /// The value was there before: what the table does not have stays.
  void add_all() { all_ = true; }

 private:
  bool all_ = false;
  std::vector<std::string_view> names_;  ///< of rows
};

struct FieldTable {
  std::string_view name;   ///< "carve"
  std::string_view words;  ///< "a carve"
  std::string_view what;   ///< for the reference
  std::span<const FieldRow> rows;
  /// Fills in what depends on other fields or on the world, and checks the whole. Null: nothing does.
  Result<void> (*finish)(void* of, const GivenFields& given, const RulesMoment& moment) = nullptr;
};

enum class FieldsNeeded : uint8_t { as_the_rows_say, none };

/// Reads a table's fields into the value that the rows are of. A field that is none is an error, which lists
/// those there are; so is one that is missing. `besides`: names that it may have, too.
Result<void> read_fields(void* to, const ScriptValue& table, const FieldTable& fields,
                         const RulesMoment& moment, std::initializer_list<std::string_view> besides = {},
                         FieldsNeeded needed = FieldsNeeded::as_the_rows_say);

/// Writes the fields into the table that is open.
void write_fields(const void* from, ScriptWriter& to, const FieldTable& fields, const RulesMoment& moment);

}  // namespace scree
