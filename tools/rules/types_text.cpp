#include "tools/rules/types_text.h"

#include <set>

#include "server/rules/api.h"
#include "server/rules/prelude.h"
#include "tools/rules/api_words.h"
#include "tools/rules/test_script.h"
#include "tools/rules/written_file.h"

namespace scree {

namespace {

constexpr std::string_view heading =
    "---@meta\n"
    "-- Written by `scree rules types` for editors; servers do not read it. A new version of Scree writes it "
    "anew.\n\n";

/// LuaLS reads "string?|table?", and "…" is no name of a field.
std::string luals_type(std::string_view type) {
  std::string text;
  for (const char c : type)
    if (c != ' ') text += c;
  return text;
}

std::string comment(std::string_view what) {
  return "---" + indented(what, "---") + "\n";
}

std::string function_text(std::string_view name, std::string_view arguments, std::string_view returns,
                          std::string_view what, std::string_view example) {
  std::string text = comment(what);
  if (!example.empty()) text += "---```lua\n---" + indented(example, "---") + "\n---```\n";
  std::string names;
  for (const WordedField& one : arguments_of(arguments)) {
    text += "---@param " + name_of(one) + " " + luals_type(one.type) + "\n";
    names += (names.empty() ? "" : ", ") + one.name;
  }
  for (const std::string& type : types_of(returns)) text += "---@return " + luals_type(type) + "\n";
  return text + "function " + std::string(name) + "(" + names + ") end\n\n";
}

std::string class_text(std::string_view name, const std::vector<WordedField>& fields, std::string_view what) {
  std::string text = comment(what) + "---@class " + std::string(name) + "\n";
  for (const WordedField& field : fields) {
    const std::string named = field.name == "…" ? "[string]" : name_of(field);
    text += "---@field " + named + " " + (field.name == "…" ? "any" : luals_type(field.type)) +
            (field.what.empty() ? "" : " " + field.what) + "\n";
  }
  return text + "\n";
}

/// Types that are texts, numbers or handles as well as tables.
std::string type_text(const ApiType& type) {
  if (type.name == "vec") return {};  // the prelude's own
  if (type.name == "material") return comment(type.what) + "---@alias material string|integer\n\n";
  const std::string text =
      class_text(type.name == "store" ? "store_owner" : type.name, fields_of_type(type.fields), type.what);
  return type.name == "store" ? text + "---@alias store string|person|store_owner\n\n" : text;
}

std::string handles_text() {
  std::string text;
  std::set<std::string_view> types;
  for (const ApiFunction& row : all_api())
    if (row.table.ends_with(':')) types.insert(row.table);
  for (const std::string_view type : types) {
    const std::string name(type.substr(0, type.size() - 1));
    text += "---@class " + name + "\nlocal " + name + " = {}\n\n";
  }
  return text;
}

std::string tables_text() {
  std::string text;
  std::set<std::string_view> tables;
  for (const ApiFunction& row : all_api())
    if (!row.table.empty() && !row.table.ends_with(':')) tables.insert(row.table);
  for (const std::string_view table : tables) text += std::string(table) + " = {}\n";
  return text + "\n";
}

std::string events_text() {
  std::string text;
  for (const ApiEvent& event : api_events()) {
    const std::string name = "on_" + std::string(event.name);
    text += class_text(name, arguments_of(event.arguments),
                       "What handlers of on." + std::string(event.name) + " get.");
    const std::string returns = event.returns.empty() ? "" : ": " + luals_type(event.returns);
    text += comment(event.what) + "---@param handler fun(e: " + name + ")" + returns + "\nfunction on." +
            std::string(event.name) + "(handler) end\n\n";
  }
  return text;
}

/// The annotations in the prelude and its functions, as the prelude has them.
std::string prelude_text() {
  return "---A place, a direction or a speed; y is up, metres.\n"
         "---@class vec\n---@field x number\n---@field y number\n---@field z number\n"
         "---@operator add(vec): vec\n---@operator sub(vec): vec\n---@operator mul(number|vec): vec\n"
         "---@operator div(number): vec\n---@operator unm: vec\nlocal vec_methods = {}\n"
         "---@return number\nfunction vec_methods:length() end\n"
         "---@return vec\nfunction vec_methods:unit() end\n"
         "---@param b vec\n---@return number\nfunction vec_methods:dot(b) end\n"
         "---@param b vec\n---@return vec\nfunction vec_methods:cross(b) end\n"
         "---@param b vec\n---@return number\nfunction vec_methods:distance(b) end\n"
         "---@param x number|table\n---@param y? number\n---@param z? number\n---@return vec\n"
         "function vec(x, y, z) end\n\n";
}

}  // namespace

std::string types_text() {
  std::string text(heading);
  text += prelude_text() + handles_text();
  for (const ApiType& type : api_types()) text += type_text(type);
  text += tables_text() + events_text();
  for (const ApiFunction& row : all_api())
    if (row.table != "on")
      text += function_text(whole_name(row), row.arguments, row.returns, row.what, row.example);
  return text;
}

std::string test_types_text() {
  std::string text(heading);
  text += "---What a test gets: a world with the folder's rules.\n---@class rules_test\nlocal t = {}\n\n";
  for (const auto part : {test_world_functions(), test_person_functions(), test_lua_functions()})
    for (const TestFunction& row : part)
      text += function_text("t:" + std::string(row.name), row.arguments, row.returns, row.what, "");
  for (const TestFunction& row : test_globals())
    text += function_text(row.name, row.arguments, row.returns, row.what, "");
  return text;
}

std::string luarc_text() {
  return R"({
  "runtime.version": "Lua 5.4",
  "runtime.builtin": { "io": "disable", "os": "disable", "debug": "disable", "package": "disable" },
  "workspace.library": ["types"],
  "diagnostics.globals": []
}
)";
}

Result<void> write_types(const std::string& folder) {
  TRY(write_new_file(folder + "/types/scree.lua", types_text(), Existing::replaced));
  TRY(write_new_file(folder + "/types/tests.lua", test_types_text(), Existing::replaced));
  return write_new_file(folder + "/.luarc.json", luarc_text(), Existing::replaced);
}

}  // namespace scree
