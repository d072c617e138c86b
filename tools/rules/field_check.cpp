#include "tools/rules/field_check.h"

#include <fmt/format.h>
#include <map>
#include <set>

#include "server/rules/api.h"
#include "tools/rules/api_words.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

/// Walks the syntax tree. Only tables that stand in a call are looked at, and names that the folder's own
/// files give to fields pass as methods: what it says is wrong, or at least odd.
constexpr std::string_view walker = R"LUA(
local parser = require "luacheck.parser"
local decoder = require "luacheck.decoder"
local trees, own = {}, {}

local function say(file, node, words) print(("%s:%d:%d: %s"):format(file, node.line, node.offset, words)) end

local function listed(names)
  local all = {}
  for name in pairs(names) do all[#all + 1] = name end
  table.sort(all)
  return table.concat(all, ", ")
end

local function each(node, call)
  for _, child in ipairs(node) do if type(child) == "table" then call(child) end end
end

local function text_of(node) return node and node.tag == "String" and node[1] or nil end

-- What the files themselves name: fields that are set, and those of their tables.
local function collect(node)
  if node.tag == "Index" or node.tag == "Pair" then
    local name = text_of(node[node.tag == "Pair" and 1 or 2])
    if name and (node.tag == "Pair" or node.is_set) then own[name] = true end
  elseif node.tag == "Set" then
    for _, to in ipairs(node[1]) do to.is_set = true end
  end
  each(node, collect)
end

local check_table

local function check_value(file, node, wanted)
  if node.tag ~= "Table" then return end
  for kind in wanted:gmatch("[^|%s]+") do
    local item = kind:match("^(.-)%[%]$")
    if item then
      each(node, function(child) check_value(file, child, item) end)
    elseif types[kind] then
      check_table(file, node, kind)
    end
  end
end

function check_table(file, node, kind)
  local fields = types[kind]
  each(node, function(pair)
    local name = pair.tag == "Pair" and text_of(pair[1])
    if not name then return end
    if fields[name] then
      check_value(file, pair[2], fields[name])
    elseif not besides[name] then
      say(file, pair[1], ("%s has no field '%s': there are %s"):format(kind, name, listed(fields)))
    end
  end)
end

local function check_arguments(file, call, first, wanted)
  for i, kind in ipairs(wanted) do
    if call[first + i] then check_value(file, call[first + i], kind) end
  end
end

-- Whether the name is bound or set again below, so that it may be something else there.
local function is_bound(node, name)
  local bound = false
  local function look(of)
    local places = (of.tag == "Local" or of.tag == "Set" or of.tag == "Function" or of.tag == "Forin") and of[1]
      or of.tag == "Fornum" and { of[1] } or {}
    for _, place in ipairs(places) do
      if type(place) == "table" and place.tag == "Id" and place[1] == name then bound = true end
    end
    each(of, look)
  end
  look(node)
  return bound
end

local function check_handler(file, event, handler)
  local fields, first = events[event], handler[1][1]
  if not fields or not first or first.tag ~= "Id" or is_bound(handler[2], first[1]) then return end
  local set = {}
  local function look(node)
    if node.tag == "Index" and node[1].tag == "Id" and node[1][1] == first[1] then
      local name = text_of(node[2])
      if node.is_set and name then set[name] = true end
      if name and not fields[name] and not set[name] then
        say(file, node[2], ("on.%s gives no '%s': there are %s"):format(event, name, listed(fields)))
      end
    end
    each(node, look)
  end
  look(handler[2])
end

local function check(file, node)
  if node.tag == "Invoke" then
    local name = text_of(node[2])
    if methods[name] then
      check_arguments(file, node, 2, methods[name])
    elseif not own[name] then
      say(file, node[2], ("there is no method '%s'"):format(name))
    end
  elseif node.tag == "Call" then
    local of, name = node[1].tag == "Index" and node[1][1], nil
    if of and of.tag == "Id" then name = of[1] .. "." .. (text_of(node[1][2]) or "")
    elseif node[1].tag == "Id" then name = node[1][1] end
    if functions[name] then check_arguments(file, node, 1, functions[name]) end
    local event = name and name:match("^on%.(.+)$")
    if event and node[2] and node[2].tag == "Function" then check_handler(file, event, node[2]) end
  end
  each(node, function(child) check(file, child) end)
end

for name in pairs(string) do methods[name] = {} end
for _, file in ipairs(arg) do
  local opened = assert(io.open(file, "rb"))
  local text = opened:read("*a")
  opened:close()
  local parsed, tree = pcall(parser.parse, decoder.decode(text))
  if parsed then
    trees[#trees + 1] = { file, tree }
    collect(tree)
  end
end
for _, one in ipairs(trees) do check(one[1], one[2]) end
)LUA";

/// Lua's own, beside those of the Lua that runs the script.
constexpr std::string_view later_methods[] = {"pack", "unpack", "packsize"};
constexpr std::string_view vec_methods[] = {"length", "unit", "dot", "cross", "distance"};
/// Fields that every request may have (server/rules/request_table.h).
constexpr std::string_view request_fields[] = {"kind", "by"};

std::string lua_key(std::string_view text) {
  return fmt::format("[\"{}\"]", text);
}

std::string fields_text(const std::vector<WordedField>& fields) {
  std::string text = "{ ";
  for (const WordedField& field : fields)
    text += fmt::format("{} = \"{}\", ", lua_key(field.name), field.type);
  return text + "}";
}

/// The types of arguments, in order.
std::string argument_types(std::string_view arguments) {
  std::string text = "{ ";
  for (const WordedField& argument : arguments_of(arguments)) text += fmt::format("\"{}\", ", argument.type);
  return text + "}";
}

std::string types_table() {
  std::string text = "types = {\n";
  for (const ApiType& type : api_types())
    if (!type.fields.empty())
      text += fmt::format("{} = {},\n", lua_key(type.name), fields_text(fields_of_type(type.fields)));
  return text + "}\n";
}

/// Those of a request differ from kind to kind: they are left out.
std::string events_table() {
  std::string text = "events = {\n";
  for (const ApiEvent& event : api_events())
    if (event.name != "request")
      text += fmt::format("{} = {},\n", lua_key(event.name), fields_text(arguments_of(event.arguments)));
  return text + "}\n";
}

/// A method's name may be that of several types: then its arguments are not known.
class MethodTable {
 public:
  void add(std::string_view name, const std::string& arguments) {
    const auto [row, is_new] = rows_.try_emplace(std::string(name), arguments);
    if (!is_new && row->second != arguments) row->second = "{}";
  }
  std::string text() const {
    std::string text = "methods = {\n";
    for (const auto& [name, arguments] : rows_) text += fmt::format("{} = {},\n", lua_key(name), arguments);
    return text + "}\n";
  }

 private:
  std::map<std::string, std::string> rows_;
};

std::string functions_and_methods() {
  std::string functions = "functions = {\n";
  MethodTable methods;
  for (const ApiFunction& row : all_api()) {
    const std::string arguments = argument_types(row.arguments);
    if (row.table.ends_with(':'))
      methods.add(row.name, arguments);
    else
      functions += fmt::format("{} = {},\n", lua_key(whole_name(row)), arguments);
  }
  for (const auto part : {test_world_functions(), test_person_functions(), test_lua_functions()})
    for (const TestFunction& row : part) methods.add(row.name, argument_types(row.arguments));
  for (const std::string_view kind : test_request_kinds())
    methods.add(kind, fmt::format("{{ \"\", \"{}\" }}", kind));
  for (const std::string_view name : vec_methods) methods.add(name, "{}");
  for (const std::string_view name : later_methods) methods.add(name, "{}");
  return functions + "}\n" + methods.text();
}

}  // namespace

std::string field_check_script() {
  std::string besides = "besides = { ";
  for (const std::string_view name : request_fields) besides += fmt::format("{} = true, ", name);
  return types_table() + events_table() + functions_and_methods() + besides + "}\n" + std::string(walker);
}

}  // namespace scree
