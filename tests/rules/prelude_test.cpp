// vec, which every script finds.
#include "server/rules/prelude.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

/// The words of the fault that a text ends with; empty: it ends well.
std::string run_after_prelude(const std::string& text) {
  ScriptOptions options;
  options.name = "prelude";
  Script script = *Script::create(std::move(options));
  script.define("", "place", [](ScriptCall& call) -> Result<void> {
    call.results().vector(1.0, 2.0, 3.0);
    return {};
  });
  ScriptBudget budget{10'000'000, 10.0};
  if (const auto loaded = load_prelude(script, budget); !loaded) return loaded.error().text();
  const auto ended = script.load_text("test", text, budget);
  return ended ? "" : ended.error().message;
}

TEST(Prelude, vecs_have_the_operators_of_vectors) {
  EXPECT_EQ(run_after_prelude(R"lua(
    local a, b = vec(1, 2, 3), vec{ 4, 5, 6 }
    assert(a + b == vec(5, 7, 9) and b - a == vec(3, 3, 3) and -a == vec(-1, -2, -3))
    assert(a * 2 == vec(2, 4, 6) and 2 * a == a * 2 and a * b == vec(4, 10, 18) and b / 2 == vec(2, 2.5, 3))
    assert(a ~= b and a:dot(b) == 32 and a:cross(b) == vec(-3, 6, -3))
    assert(vec(3, 4, 0):length() == 5 and vec(0, 9, 0):unit() == vec(0, 1, 0))
    assert(vec(0, 0, 0):unit() == vec(0, 0, 0) and vec(1, 0, 0):distance{ 1, 3, 4 } == 5)
    assert(a + { 1, 1, 1 } == vec(2, 3, 4) and vec{ x = 7, y = 8, z = 9 }.y == 8)
    assert(tostring(vec(1, 2.5, -3)) == "(1, 2.5, -3)")
  )lua"),
            "");
}

TEST(Prelude, places_from_the_host_are_vecs) {
  EXPECT_EQ(run_after_prelude("assert(place() == vec(1, 2, 3) and place() + place() == vec(2, 4, 6))"), "");
}

TEST(Prelude, what_is_no_vec_is_refused_in_the_line_that_used_it) {
  EXPECT_EQ(run_after_prelude("local a = vec(1, 2)"), "test:1: vec needs three numbers, or a table of three");
  EXPECT_EQ(run_after_prelude("\nlocal a = vec(1, 2, 3) + 7"), "test:2: a vec is needed, not number");
  EXPECT_EQ(run_after_prelude("local a = vec(1, 2, 3) + { 1, 2 }"),
            "test:1: a vec has three numbers: x, y and z");
}

TEST(Prelude, nobody_reaches_the_metatable_of_vecs) {
  EXPECT_EQ(run_after_prelude(R"(
    assert(getmetatable(vec(1, 2, 3)) == "vec" and getmetatable(place()) == "vec")
    assert(vector_metatable == nil and rawget(_G, "vector_metatable") == nil)
    assert(not pcall(setmetatable, place(), {}))
  )"),
            "");
}

}  // namespace
}  // namespace scree
