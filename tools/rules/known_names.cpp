#include "tools/rules/known_names.h"

#include "server/rules/api.h"
#include "server/rules/prelude.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

/// Prints the globals as a table of luacheck: `name = { fields = {…} }`. Parts, because a text has a bound.
constexpr std::string_view listing = R"LUA(
local names = {}
for name in pairs(_G) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
  local value = _G[name]
  if type(value) ~= "table" or name == "_G" then
    print("[\"" .. name .. "\"] = { other_fields = true },")
  else
    local fields = {}
    for field in pairs(value) do fields[#fields + 1] = "[\"" .. field .. "\"] = {}" end
    table.sort(fields)
    print("[\"" .. name .. "\"] = { fields = {")
    for _, field in ipairs(fields) do print(field .. ",") end
    print("} },")
  end
end
)LUA";

constexpr int64_t listing_work_max = 10'000'000;

Result<void> list_names(Script& script) {
  ScriptBudget budget{listing_work_max, 10.0};
  if (const auto ended = script.load_text("names", listing, budget); !ended)
    return fail(ended.error().text());
  return {};
}

/// The names that rules find.
Result<std::string> names_of_rules() {
  std::string names;
  Script script = TRY(Script::create({.name = "names", .folder = {}, .print = [&](std::string_view line) {
                                        names += std::string(line) + "\n";
                                      }}));
  for (const ApiFunction& row : all_api())
    if (!row.table.ends_with(':'))
      script.define(row.table, row.name, [](ScriptCall&) -> Result<void> { return {}; });
  ScriptBudget budget{listing_work_max, 10.0};
  if (const auto loaded = load_prelude(script, budget); !loaded) return fail(loaded.error().text());
  TRY(list_names(script));
  return names;
}

Result<std::string> names_of_tests() {
  std::string names;
  RunningTest test;
  Script script = TRY(make_test_script(
      {}, test, [](ScriptCall&) {}, [&](std::string_view line) { names += std::string(line) + "\n"; }));
  TRY(list_names(script));
  return names;
}

}  // namespace

Result<std::string> luacheck_configuration() {
  std::string text = "stds.scree_rules = { read_globals = {\n" + TRY(names_of_rules()) + "} }\n";
  text += "stds.scree_tests = { read_globals = {\n" + TRY(names_of_tests()) + "} }\n";
  // Names and syntax: how a script is laid out, and what it leaves unused, is its maker's matter.
  text +=
      "std = \"scree_rules\"\nonly = { \"0\", \"1\" }\nignore = { \"131\" }\nallow_defined_top = true\n"
      "max_line_length = false\nfiles[\"**/tests/*.lua\"] = { std = \"scree_tests\" }\n"
      "exclude_files = { \"**/types/*.lua\" }\n";
  return text;
}

}  // namespace scree
