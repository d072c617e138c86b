// Every function that scripts find, called with whatever comes: it answers or refuses, and the world goes on.
#include <gtest/gtest.h>

#include "server/rules/api.h"
#include "server/rules/request_table.h"
#include "tests/support/rules_world.h"

namespace scree {
namespace {

/// "world.ray", and of a method "body:push": all that there are, as a list of Lua.
std::string names_of_functions() {
  std::string list = "{";
  for (const ApiFunction& row : all_api()) {
    // Handlers would pile up, nobody be left, and the lines of this test be lost among others.
    if (row.table == "on" || row.name == "kick" || row.name == "log") continue;
    const bool has_table = !row.table.empty() && !row.table.ends_with(':');
    list += "'" + std::string(row.table) + (has_table ? "." : "") + std::string(row.name) + "',";
  }
  return list + "}";
}

std::string names_of_fields() {
  std::string list = "{ 'by', 'kind', 'except', 'terrain', ";
  for (const FieldTable* const table : request_field_tables())
    for (const FieldRow& row : table->rows) list += "'" + std::string(row.name) + "',";
  return list + "}";
}

constexpr const char* calls = R"(
  local words = { "", "box", "capsule", "rock", "world", "red", "hinge", "pit", "islands", "\0\255", "material.rock.density" }
  local function some(list) return list[math.random(#list)] end
  local function value(depth)
    local which = math.random(depth > 2 and 9 or 12)
    if which == 1 then return math.random(-3, 50) end
    if which == 2 then return (math.random() - 0.5) * 10 ^ math.random(-5, 40) end
    if which == 3 then return some({ 0/0, 1/0, -1/0, math.maxinteger, math.mininteger, 0, 2^32 }) end
    if which == 4 then return some(words) end
    if which == 5 then return math.random(2) == 1 end
    if which == 6 then return vec(math.random() * 20 - 10, math.random() * 8 - 4, math.random() * 20 - 10) end
    if which == 7 then return bodies.all()[1] or 1 end
    if which == 8 then return persons.all()[1] or joints.all()[1] end
    if which == 9 then return function() end end
    local t = {}
    for _ = 1, math.random(0, 5) do t[some(fields)] = value(depth + 1) end
    if which == 10 then t.at = vec(math.random() * 20 - 10, 0, 0) t.radius = math.random() * 2 end
    if which == 11 then return { value(depth + 1), value(depth + 1) } end
    return t
  end
  local handles = {
    body = function() return bodies.all()[1] end,
    joint = function() return joints.all()[1] end,
    person = function() return persons.all()[1] end,
  }
  local function function_of(name)
    local type, method = name:match("^(%a+):([%a_]+)$")
    if type then
      local handle = handles[type]()
      return handle and handle[method], handle
    end
    local library, part = name:match("^(%a+)%.([%a_]+)$")
    if library then return _G[library][part] end
    return _G[name]
  end
  called, answered = 0, 0
  on.tick(function(e)
    if e.tick % 100 == 99 then log("called " .. called .. ", answered " .. answered) end
    for _ = 1, 10 do
      local call, handle = function_of(some(names))
      if call then
        called = called + 1
        local first = handle and math.random(4) > 1 and handle or value(0)
        if pcall(call, first, value(0), value(0), value(0), value(0)) then answered = answered + 1 end
      end
    end
  end)
  on.start(function()
    bodies.add({ box = vec(0.5, 0.5, 0.5), at = vec(0, 3, 0) }, function(made)
      joints.add{ kind = "rope", a = made.body, from = vec(0, 3, 0), to = vec(0, -0.5, 0) }
    end)
  end))";

TEST(RandomApiCalls, any_arguments_are_answered_or_refused) {
  RulesWorld game("local names, fields = " + names_of_functions() + ", " + names_of_fields() +
                  "\n_ENV.fields = fields\n" + calls);
  game.join("anna");
  game.join("bert");
  game.steps(400);
  EXPECT_TRUE(game.has_logged(", answered")) << game.all_logged();
  EXPECT_FALSE(game.has_logged(", answered 0")) << game.all_logged();
}

}  // namespace
}  // namespace scree
