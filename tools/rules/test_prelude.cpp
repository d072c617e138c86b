// What the files of tests find besides bound functions.
#include "tools/rules/test_script.h"

namespace scree {

std::string_view test_prelude() {
  return R"LUA(
local function shown(value)
  if type(value) == "string" then return string.format("%q", value) end
  if type(value) ~= "table" or getmetatable(value) ~= nil then return tostring(value) end
  local parts = {}
  for key, item in pairs(value) do parts[#parts + 1] = tostring(key) .. " = " .. shown(item) end
  table.sort(parts)
  return "{ " .. table.concat(parts, ", ") .. " }"
end

local function same(a, b)
  if a == b then return true end
  if type(a) ~= "table" or type(b) ~= "table" then return false end
  for key, item in pairs(a) do if not same(item, b[key]) then return false end end
  for key in pairs(b) do if a[key] == nil then return false end end
  return true
end

function expect(condition, words)
  if not condition then error(words or "it does not hold", 2) end
  return condition
end

function equal(a, b, words)
  if not same(a, b) then error((words and words .. ": " or "") .. shown(a) .. " is not " .. shown(b), 2) end
end

function near(a, b, by, words)
  if type(a) ~= "number" or type(b) ~= "number" or math.abs(a - b) > (by or 1e-6) then
    error((words and words .. ": " or "") .. shown(a) .. " is not near " .. shown(b), 2)
  end
end

local methods = {}

function methods.until_true(t, check, seconds)
  for _ = 1, math.ceil((seconds or 10) * t:rate()) do
    if check() then return true end
    t:step(1)
  end
  return check() and true or false
end

function methods.heard(t, person, text)
  for _, line in ipairs(t:lines(person)) do if line:find(text, 1, true) then return true end end
  return false
end

function methods.sign(t, person, name)
  for _, sign in ipairs(t:signs(person)) do if sign.name == name then return sign end end
  return nil
end

function run_a_test(body)
  body(setmetatable({}, { __index = function(_, name) return methods[name] or stage[name] end }))
end
)LUA";
}

namespace {

constexpr TestFunction lua_rows[] = {
    {"until_true", "check: fun(): any, seconds?: number", "boolean",
     "Lets time pass until the function gives something true, 10 s at most as usual. Whether it did.",
     nullptr},
    {"heard", "person: person, text: string", "boolean",
     "Whether one of the person's lines contains the text.", nullptr},
    {"sign", "person: person, name: string", "sign?", "The sign of that name that the person sees.", nullptr},
};

constexpr TestFunction global_rows[] = {
    {"test", "name: string, body: fun(t: rules_test)", "", "A test; it fails by an error.", nullptr},
    {"expect", "condition: any, words?: string", "any", "Fails where the condition does not hold.", nullptr},
    {"equal", "a: any, b: any, words?: string", "",
     "Fails where two values differ; tables by what they hold.", nullptr},
    {"near", "a: number, b: number, by?: number, words?: string", "",
     "Fails where two numbers differ by more than that.", nullptr},
};

}  // namespace

std::span<const TestFunction> test_lua_functions() {
  return lua_rows;
}

std::span<const TestFunction> test_globals() {
  return global_rows;
}

}  // namespace scree
