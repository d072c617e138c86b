#include "server/rules/sandbox/json_values.h"

#include "tests/rules/sandbox_support.h"

namespace scree {
namespace {

/// keep(value) gives text, back(text) the value.
class Keeping : public Played {
 public:
  Keeping() {
    script.define("", "keep", [](ScriptCall& call) -> Result<void> {
      call.results().text(TRY(to_json_text(call.argument(1, "kept"), 1000)));
      return {};
    });
    script.define("", "back", [](ScriptCall& call) -> Result<void> {
      const std::string text(TRY(call.argument(1, "text").text()));
      return write_json(call.results(), text);
    });
  }
};

TEST(JsonValues, are_written_plainly) {
  Keeping played;
  EXPECT_EQ(played.ask("keep({1, 2.0, 'a', true, {x = 1, b = {}, a = -0.0}})"),
            R"([1,2.0,"a",true,{"a":-0.0,"b":[],"x":1}])");
  EXPECT_EQ(played.ask("keep(nil)"), "null");
  EXPECT_EQ(played.ask("keep(0.1)"), "0.1");
  EXPECT_EQ(played.ask("keep(1e300)"), "1e+300");
  EXPECT_EQ(played.ask("keep(math.mininteger)"), "-9223372036854775808");
  EXPECT_EQ(played.ask("keep({1, nil, 3})"), R"({"$pairs":[[1,1],[3,3]]})");
  EXPECT_EQ(played.ask("keep('a\\xff')"), R"({"$bytes":"61ff"})");
  EXPECT_EQ(played.ask("keep({['$x'] = 1, [true] = 2, [0.5] = 3})"),
            R"({"$pairs":[[0.5,3],["$x",1],[true,2]]})");
}

TEST(JsonValues, come_back_as_they_were) {
  Keeping played;
  ASSERT_TRUE(played.run(R"(
    function same(a, b)
      if math.type(a) ~= math.type(b) or type(a) ~= type(b) then return false end
      if type(a) ~= 'table' then return a == b or (a ~= a and b ~= b) end
      for k, v in pairs(a) do if not same(v, b[k]) then return false end end
      for k in pairs(b) do if a[k] == nil then return false end end
      return true
    end)"));
  for (const char* value : {"1",
                            "1.0",
                            "-0.0",
                            "0.1",
                            "1e15",
                            "1e16",
                            "2^53",
                            "math.huge",
                            "-math.huge",
                            "0/0",
                            "math.maxinteger",
                            "math.mininteger",
                            "''",
                            "'\\0\\1\\n\"\\\\'",
                            "'\\xff\\0'",
                            "'Größe'",
                            "true",
                            "nil",
                            "{}",
                            "{1}",
                            "{1, 2.5}",
                            "{nil, 2}",
                            "{[0] = 0}",
                            "{[-5] = {x = {[7] = 'a'}}}",
                            "{['1'] = 1, [1] = '1'}",
                            "{[1.5] = 1, [math.huge] = 2}",
                            "{[true] = 1, [false] = 2}",
                            "{['$float'] = 'inf'}",
                            "{['$pairs'] = {}}",
                            "{['\\xff'] = 1}",
                            "{a = {b = {c = {}}}}"}) {
    EXPECT_EQ(played.ask("same(" + std::string(value) + ", back(keep(" + value + ")))"), "true") << value;
    EXPECT_EQ(played.ask("keep(" + std::string(value) + ") == keep(back(keep(" + value + ")))"), "true")
        << value;
  }
}

TEST(JsonValues, equal_tables_give_equal_text) {
  Keeping played;
  EXPECT_EQ(
      played.ask(
          "(function() local a, b = {}, {} for i = 1, 50 do a['k' .. i] = i b['k' .. 51 - i] = 51 - i end "
          "return keep(a) == keep(b) end)()"),
      "true");
}

TEST(JsonValues, refuse_with_the_place) {
  Keeping played;
  EXPECT_EQ(played.ask("keep({items = {1, print}})"),
            "! console:1: argument 1 (kept).items[…]: a function cannot be kept");
  EXPECT_EQ(played.ask("keep({[print] = 1})"),
            "! console:1: a key of argument 1 (kept): a function cannot be kept");
  EXPECT_EQ(played.ask("(function() local t = {} t.x = {t} return keep(t) end)()"),
            "! console:1: argument 1 (kept).x[…]: the table lies in itself");
  EXPECT_EQ(
      played.ask("(function() local t = {} for i = 1, 40 do t = {t} end return keep(t) end)()").substr(0, 13),
      "! console:1: ");
  EXPECT_EQ(played.ask("keep(('x'):rep(2000))"), "! console:1: a value is longer than 1000 bytes as JSON");
  EXPECT_EQ(played.ask("(function() local t = {} for i = 1, 5000 do t[i] = 1 end return keep(t) end)()"),
            "! console:1: a value is longer than 1000 bytes as JSON");
  EXPECT_EQ(
      played.ask("(function() local t = {} for i = 1, 31 do t = {[2] = t} end return #keep(t) > 0 end)()"),
      "true");
  EXPECT_EQ(played.ask("(function() local t = {} for i = 1, 31 do t = {[2] = t} end return "
                       "keep(back(keep(t))) == keep(t) end)()"),
            "true");
}

TEST(JsonValues, a_table_may_lie_in_two_places) {
  Keeping played;
  EXPECT_EQ(played.ask("(function() local t = {1} return keep({t, t}) end)()"), "[[1],[1]]");
}

TEST(JsonValues, text_that_is_none_is_refused_and_leaves_nothing) {
  Keeping played;
  for (const char* text :
       {"", "{", "[1,]", "{\"$float\":\"x\"}", "{\"$bytes\":\"0\"}", "{\"$bytes\":\"zz\"}",
        "{\"$pairs\":[[1]]}", "{\"$pairs\":[[null,1]]}", "{\"$pairs\":[[{\"$float\":\"nan\"},1]]}",
        "{\"$pairs\":1}", "{\"$what\":\"x\"}", "{\"$float\":1}", "1 2", "nul"}) {
    std::string quoted = "[==[" + std::string(text) + "]==]";
    EXPECT_EQ(played.ask("select('#', pcall(back, " + quoted + ")), (pcall(back, " + quoted + "))"),
              "2\tfalse")
        << text;
  }
  EXPECT_EQ(played.ask("back(('['):rep(60000))"), "! console:1: tables lie in tables more than 32 deep");
}

}  // namespace
}  // namespace scree
