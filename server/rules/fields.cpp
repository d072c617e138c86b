#include "server/rules/fields.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

bool row_applies(const FieldRow& row, const void* of) {
  return row.applies == nullptr || row.applies(of);
}

std::string names_of_fields(const void* of, const FieldTable& fields) {
  std::string names;
  for (const FieldRow& row : fields.rows)
    if (row_applies(row, of)) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

/// Refuses the first key that is no field of the value as it was read.
Result<void> check_keys(const void* of, const ScriptValue& table, const FieldTable& fields,
                        std::initializer_list<std::string_view> besides) {
  return table.each([&](const ScriptValue& key, const ScriptValue&) -> Result<void> {
    std::string shown = "an item without a name";
    if (key.is_text()) {
      const std::string_view name = TRY(key.text());
      const auto has_name = [&](const FieldRow& row) { return row.name == name && row_applies(row, of); };
      if (std::ranges::any_of(fields.rows, has_name) || std::ranges::find(besides, name) != besides.end())
        return {};
      shown = "'" + std::string(name.substr(0, 64)) + "'";
    }
    return fail(table.name() + ": " + shown + " is no field of " + std::string(fields.words) + ": " +
                names_of_fields(of, fields));
  });
}

}  // namespace

bool GivenFields::has(std::string_view name) const {
  return all_ || std::ranges::find(names_, name) != names_.end();
}

Result<void> read_fields(void* to, const ScriptValue& table, const FieldTable& fields,
                         const RulesMoment& moment, std::initializer_list<std::string_view> besides,
                         FieldsNeeded needed) {
  if (!table.is_table())
    return fail(table.name() + " is " + table.type_text() + ", not a table with the fields of " +
                std::string(fields.words));
  const ReadScope scope(table);
  GivenFields given;
  if (needed == FieldsNeeded::none) given.add_all();
  for (const FieldRow& row : fields.rows) {
    const ScriptValue value = TRY(table.field(row.name));
    if (value.is_nil() || !row_applies(row, to)) continue;
    TRY(row.read(to, value, moment));
    given.add(row.name);
  }
  TRY(check_keys(to, table, fields, besides));
  for (const FieldRow& row : fields.rows)
    if (row.needed && row_applies(row, to) && !given.has(row.name))
      return fail(table.name() + ": " + std::string(fields.words) + " needs '" + std::string(row.name) +
                  "': " + std::string(row.what));
  return fields.finish == nullptr ? Result<void>{} : fields.finish(to, given, moment);
}

void write_fields(const void* from, ScriptWriter& to, const FieldTable& fields, const RulesMoment& moment) {
  for (const FieldRow& row : fields.rows) {
    const bool is_written =
        row.write != nullptr && row_applies(row, from) && (row.is_there == nullptr || row.is_there(from));
    if (!is_written) continue;
    to.name(row.name);
    row.write(from, to, moment);
  }
}

}  // namespace scree
