// Scripts that try to run on, to fill the memory or to reach the machine.
#include <algorithm>

#include "tests/rules/sandbox_support.h"

namespace scree {
namespace {

struct Attack {
  const char* name;
  const char* text;
  std::vector<ScriptFault::Kind> kinds;
};

using enum ScriptFault::Kind;

void PrintTo(const Attack& attack, std::ostream* to) {
  *to << attack.name;
}

class Undermining : public testing::TestWithParam<Attack> {};

/// With 8 MiB and a million units of work most take tens of ms. Where instructions are dear, as comparisons
/// of long texts, the clock ends the call. It may be late by a step of the collector, a search or a block.
constexpr double attack_cpu_s = 0.03;
constexpr double late_s_max = 0.05;
#ifdef SCREE_CHECK_DEBUG
constexpr double slowness = 20;
#else
constexpr double slowness = 1;
#endif

/// What the attack took, s.
double attack(const Attack& with, Played& played) {
  const double begin_s = thread_cpu_s();
  const auto ended = played.run(with.text);
  const double took_s = thread_cpu_s() - begin_s;
  EXPECT_FALSE(ended);
  if (ended) return took_s;
  EXPECT_NE(std::ranges::find(with.kinds, ended.error().kind), with.kinds.end()) << ended.error().text();
  EXPECT_LE(took_s, attack_cpu_s + late_s_max * slowness) << ended.error().text();
  EXPECT_EQ(played.ask("1 + 1"), "2") << "the script goes on";
  return took_s;
}

TEST_P(Undermining, ends_in_time_and_within_memory) {
  ScriptOptions options = small_options();
  options.cpu_max_s = attack_cpu_s;
  Played played(options);
  const double took_s = attack(GetParam(), played);
  EXPECT_LE(played.script.used().memory_most_bytes, options.memory_max_bytes + (16U << 20U));
  RecordProperty("ms", std::to_string(took_s * 1e3));
  RecordProperty("bytes", std::to_string(played.script.used().memory_most_bytes));
}

/// Without a limit of work: no function runs long unwatched.
TEST_P(Undermining, ends_by_the_clock) {
  ScriptOptions options = small_options();
  options.cpu_max_s = attack_cpu_s;
  options.work_max = int64_t{1} << 60U;
  options.memory_max_bytes = size_t{64} << 20U;
  Played played(options);
  ScriptBudget budget{options.work_max, 60};
  const double begin_s = thread_cpu_s();
  const auto ended = played.script.load_text("test", GetParam().text, budget);
  const double took_s = thread_cpu_s() - begin_s;
  EXPECT_FALSE(ended);
  EXPECT_LE(took_s, attack_cpu_s + late_s_max * slowness) << ended.error().text();
  RecordProperty("clock_ms", std::to_string(took_s * 1e3));
}

const Attack attacks[] = {
    {"loop", "while true do end", {too_long}},
    {"goto_loop", "::a:: goto a", {too_long}},
    {"repeat_in_pcall", "while true do pcall(function() while true do end end) end", {too_long}},
    {"nested_pcalls", "local function f() while true do pcall(f) end end f()", {too_long}},
    {"pcall_of_pcall", "while true do pcall(pcall, pcall, pcall, error) end", {too_long}},
    {"error_handlers",
     "while true do xpcall(function() while true do end end, function() while true do end end) end",
     {too_long}},
    {"handler_of_error", "xpcall(error, function() while true do end end)", {too_long}},
    {"handler_in_handler",
     "local function h(m) xpcall(error, h) while true do end end xpcall(error, h)",
     {too_long}},
    {"coroutine_loop", "coroutine.wrap(function() while true do end end)()", {too_long}},
    {"coroutine_in_pcall",
     "while true do local c = coroutine.create(function() while true do end end) coroutine.resume(c) end",
     {too_long}},
    {"pcall_in_coroutine",
     "coroutine.wrap(function() while true do pcall(function() while true do end end) end end)()",
     {too_long}},
    {"yields",
     "local c = coroutine.wrap(function() while true do coroutine.yield() end end) while true do c() end",
     {too_long}},
    {"short_coroutines", "while true do coroutine.wrap(function() local a = 1 end)() end", {too_long}},
    // Each runs fewer instructions than an interval, and starts ten others.
    {"nested_short_coroutines",
     "local function f(n) if n == 0 then return end for i = 1, 8 do coroutine.wrap(f)(n - 1) end end f(60)",
     {too_long, error}},
    {"nested_coroutines",
     "local function f() return coroutine.wrap(f)() end f()",
     {too_long, error, out_of_memory}},
    {"coroutines_kept",
     "local t = {} while true do t[#t + 1] = coroutine.create(print) end",
     {too_long, out_of_memory}},
    {"close_handlers",
     "local function f() local c <close> = setmetatable({}, {__close = function() while true do end end}) "
     "error('x') "
     "end while true do pcall(f) end",
     {too_long}},
    {"close_after_the_end",
     "local c <close> = setmetatable({}, {__close = function() while true do end end}) while true do end",
     {too_long}},
    {"close_in_coroutine",
     "while true do pcall(coroutine.wrap(function() local c <close> = setmetatable({}, {__close = function() "
     "while "
     "true do end end}) while true do end end)) end",
     {too_long}},
    {"deep_close",
     "local m = {__close = function() while true do end end} local function f() local c <close> = "
     "setmetatable({}, m) "
     "f() end while true do pcall(f) end",
     {too_long, out_of_memory}},
    {"recursion", "local function f() return 1 + f() end f()", {error, out_of_memory, too_long}},
    {"recursion_in_pcall",
     "local function f() f() end while true do pcall(f) end",
     {out_of_memory, too_long}},
    {"recursion_of_tostring",
     "local t = setmetatable({}, {}) getmetatable(t).__tostring = function() return tostring(t) end "
     "tostring(t)",
     {error, too_long, out_of_memory}},
    {"recursion_of_index",
     "local t = setmetatable({}, {__index = function(t, k) return t[k .. 'x'] end}) local x = t.a",
     {error, too_long, out_of_memory}},
    {"metatable_chain",
     "local t = {} for i = 1, 1900 do t = setmetatable({}, {__index = t}) end while true do local x = t.a "
     "end",
     {too_long}},
    {"metatable_ring",
     "local t = {} setmetatable(t, {__index = t}) while true do pcall(function() return t.x end) end",
     {too_long}},
    {"eq_handlers",
     "local m = {} m.__eq = function(a, b) return a == b end local a, b = setmetatable({}, m), "
     "setmetatable({}, m) local x = a == b",
     {error, too_long, out_of_memory}},
    {"table_of_a_billion", "local t = {} for i = 1, 1e9 do t[i] = i end", {too_long, out_of_memory}},
    {"tables", "local t = {} while true do t = {t} end", {too_long, out_of_memory}},
    {"tables_in_pcall",
     "local t = {} while true do pcall(function() while true do t = {t, {}, {}} end end) end",
     {too_long, out_of_memory}},
    {"names", "local t = {} for i = 1, 1e9 do t['k' .. i] = i end", {too_long, out_of_memory}},
    {"doubling", "local s = 'x' while true do s = s .. s end", {out_of_memory}},
    {"doubling_in_pcall",
     "while true do pcall(function() local s = 'x' while true do s = s .. s end end) end",
     {out_of_memory}},
    {"joining",
     "local s = ('x'):rep(65000) while true do local t = s .. s .. s .. s .. s .. s .. s .. s end",
     {out_of_memory}},
    {"joining_within", "local s = ('x'):rep(30000) while true do local t = s .. s end", {too_long}},
    {"rep", "while true do pcall(string.rep, 'x', 1 << 40) end", {too_long}},
    {"rep_of_nothing", "('x'):rep(1 << 62, '')", {error}},
    {"rep_with_separator", "while true do pcall(string.rep, '', 1 << 40, 'x') end", {too_long}},
    {"rep_within", "while true do local s = ('x'):rep(65536) end", {too_long}},
    {"concat",
     "local t = {} for i = 1, 1000 do t[i] = ('x'):rep(60000) end table.concat(t)",
     {error, out_of_memory, too_long}},
    {"concat_of_one",
     "local t = setmetatable({}, {__index = rawlen}) table.concat(t, '', 1, 1 << 40)",
     {error, too_long}},
    {"concat_far",
     "table.concat(setmetatable({}, {__index = function() return '' end}), '', 1, math.maxinteger)",
     {too_long}},
    {"format", "while true do local s = ('%99.99f'):rep(99):format(1e308, 1e308) end", {error}},
    {"format_width", "while true do pcall(string.format, '%099999999d', 1) end", {too_long}},
    {"format_texts",
     "local s = ('x'):rep(60000) while true do local t = string.format('%s%s%s%s', s, s, s, s) end",
     {error}},
    {"format_quoted",
     "local s = ('\\0'):rep(30000) while true do local t = string.format('%q', s) end",
     {too_long, out_of_memory}},
    {"sort", "local t = {} for i = 1, 30000 do t[i] = -i end while true do table.sort(t) end", {too_long}},
    {"sort_without_order",
     "local t = {} for i = 1, 3000 do t[i] = i end table.sort(t, function() return true end) error('end')",
     {error}},
    {"sort_of_zeros",
     "local t = {} for i = 1, 60 do t[i] = ('\\0'):rep(65000) .. i end while true do table.sort(t) end",
     {too_long}},
    {"sort_far", "table.sort(setmetatable({}, {__len = function() return 1 << 40 end}))", {error}},
    {"insert", "local t = {} for i = 1, 60000 do table.insert(t, 1, i) end", {too_long}},
    {"insert_far",
     "table.insert(setmetatable({}, {__len = function() return 1 << 60 end}), 1, 1)",
     {too_long}},
    {"remove_far", "table.remove(setmetatable({}, {__len = function() return 1 << 60 end}), 1)", {too_long}},
    {"move", "table.move({}, 1, math.maxinteger - 1, 2)", {too_long}},
    {"unpack", "while true do pcall(table.unpack, {}, 1, 1e7) end", {too_long}},
    {"unpack_within", "while true do table.unpack({}, 1, 10000) end", {too_long}},
    {"bytes", "local s = ('x'):rep(65000) while true do s:byte(1, -1) end", {error, too_long, out_of_memory}},
    {"many_arguments", "local function f(...) return f(1, ...) end f()", {error, too_long, out_of_memory}},
    {"select",
     "local t = {} for i = 1, 15000 do t[i] = i end local function f(...) while true do local x = "
     "select(-1, ...) end end f(table.unpack(t))",
     {too_long}},
    {"pack", "string.pack('c1000000000', 'x')", {error}},
    {"pack_often", "while true do pcall(string.pack, 'c65000', 'x') end", {too_long}},
    {"unpack_text", "while true do pcall(string.unpack, 'c1000000000', 'x') end", {too_long}},
    {"upper", "local s = ('x'):rep(65000) while true do s:upper() end", {too_long}},
    {"reverse", "local s = ('x'):rep(65000) while true do s:reverse() end", {too_long}},
    {"utf8_length", "local s = ('x'):rep(65000) while true do utf8.len(s) end", {too_long}},
    {"utf8_codes",
     "local s = ('x'):rep(65000) while true do for p, c in utf8.codes(s) do end end",
     {too_long}},
    {"zeros_compared",
     "local a, b = ('\\0'):rep(65000) .. 'a', ('\\0'):rep(65000) .. 'b' while true do local x = a < b end",
     {too_long}},
    {"texts_compared",
     "local a, b = ('x'):rep(65000) .. 'a', ('x'):rep(65000) .. 'b' while true do local x = a == b end",
     {too_long}},
    {"texts_as_numbers", "local a = ('0'):rep(65000) .. '1' while true do local x = a + 1 end", {too_long}},
    {"texts_to_numbers", "local a = ('0'):rep(65000) .. '1' while true do tonumber(a, 10) end", {too_long}},
    {"long_keys", "local t, a = {}, ('x'):rep(60000) for i = 1, 1e9 do local x = t[a .. i] end", {too_long}},
    {"colliding_keys",
     "local t, k = {}, (1 << 17) - 1 for i = 1, 1e9 do t[i * k] = i end",
     {too_long, out_of_memory}},
    {"next_over_nothing",
     "local t = {} for i = 1, 30000 do t['k' .. i] = i end for i = 1, 30000 do t['k' .. i] = nil end while "
     "true do "
     "next(t) end",
     {too_long}},
    {"pattern_backtracks",
     "local s = ('a'):rep(60000) while true do s:find(('a?'):rep(30) .. ('a'):rep(30)) end",
     {too_long, error}},
    {"pattern_of_any", "local s = ('a'):rep(60000) while true do s:find('.-.-.-.-.-.-b') end", {too_long}},
    {"pattern_too_large",
     "while true do pcall(string.find, ('a'):rep(60000), ('[ab]*'):rep(51)) end",
     {too_long}},
    {"patterns_compiled", "for i = 1, 1e9 do ('x'):find('[a-c]*' .. i .. '.*') end", {too_long}},
    {"patterns_kept",
     "local t = {} for i = 1, 1e9 do t[i] = ('x'):gmatch('[a-c]*' .. i) end",
     {out_of_memory, too_long}},
    {"gsub_grows", "local s = ('x'):rep(60000) while true do s:gsub('x', 'xxxx') end", {error}},
    {"gsub_of_nothing", "local s = ('x'):rep(60000) while true do s:gsub('', '') end", {too_long}},
    {"gsub_calls", "('x'):rep(60000):gsub('x', function() while true do end end)", {too_long}},
    {"gsub_in_gsub", "local function f() return ('x'):gsub('x', f) end f()", {error, too_long}},
    {"find_plain",
     "local s = ('a'):rep(60000) while true do s:find(('a'):rep(30000) .. 'b', 1, true) end",
     {too_long}},
    {"load_much", "while true do load(('x = 1 '):rep(10000)) end", {too_long}},
    {"load_branches",
     "load('if x then ' .. ('elseif x then '):rep(4600) .. ' end') load('while x do ' .. ('break "
     "'):rep(10000) .. 'end') "
     "local s = '' for i = 1, 6000 do s = s .. '::a' .. i .. '::' end load(s) while true do load(s) end",
     {too_long, out_of_memory}},
    {"load_for_ever", "load(function() return 'x = 1 ' end)", {error, too_long, out_of_memory}},
    {"load_numbers", "assert(load(collectgarbage))", {error}},
    {"load_nested", "local s = ('('):rep(30000) assert(load('x = ' .. s))", {error}},
    {"print_much", "local s = ('x'):rep(60000) while true do print(s, s, s) end", {too_long}},
    {"errors_far",
     "local function f(n) if n > 0 then f(n - 1) end error('x', 1 << 30) end while true do pcall(f, 100) end",
     {too_long}},
    {"weak_keys_late",
     "local m = {} local e = setmetatable({}, m) m.__mode = 'k' for i = 1, 1e9 do e[{}] = {} end",
     {error}},
    {"numbers_for", "for i = 1, math.huge do end", {too_long}},
    {"for_without_end", "for i = math.mininteger, math.maxinteger do end", {too_long}},
    {"garbage", "while true do local t = {} end", {too_long}},
    {"closures",
     "local t = {} while true do t[#t + 1] = function() return t end end",
     {too_long, out_of_memory}},
};

INSTANTIATE_TEST_SUITE_P(Attacks, Undermining, testing::ValuesIn(attacks),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(Machine, is_out_of_reach) {
  Played played;
  for (const char* name : {"io", "os", "debug", "package", "dofile", "loadfile", "warn", "string.dump",
                           "math.randomseed", "coroutine.close"})
    EXPECT_EQ(played.ask(name), "nil") << name;
  EXPECT_EQ(played.ask("collectgarbage('count') > 10"), "true");
  EXPECT_EQ(played.ask("collectgarbage()"), "! console:1: collectgarbage(\"count\") alone is available here");
  EXPECT_EQ(played.ask("require('x')"), "! console:1: script test has no folder");
  EXPECT_EQ(played.ask("load('\\27Lua')"), "nil\tattempt to load a binary chunk (mode is 't')");
  EXPECT_EQ(played.ask("load('x', 'x', 'b')"),
            "! console:1: load: mode \"t\" (text) alone is available here");
}

TEST(Machine, no_address_is_shown) {
  Played played;
  EXPECT_EQ(played.ask("tostring({}), tostring(print), tostring(coroutine.create(print)), ('%s'):format({})"),
            "table\tfunction\tthread\ttable");
  EXPECT_EQ(played.ask("('%p'):format({})"), "! console:1: %p is not available here");
  EXPECT_EQ(played.ask("tostring(setmetatable({}, {__name = 'box'}))"), "box");
}

TEST(Machine, finalizers_and_weak_keys_are_refused) {
  Played played;
  EXPECT_EQ(played.ask("setmetatable({}, {__gc = print})"), "! console:1: __gc is not available here");
  EXPECT_EQ(
      played.ask(
          "(function() local m = {} local t = setmetatable({}, m) m.__gc = print setmetatable(t, m) end)()"),
      "! console:1: __gc is not available here");
  EXPECT_EQ(played.ask("setmetatable({}, {__mode = 'k'})"),
            "! console:1: weak keys (__mode = \"k\") are not available here; \"v\" and \"kv\" are");
  EXPECT_EQ(played.ask("setmetatable({}, {__mode = 'kv'})"), "{}");
}

TEST(Machine, the_library_is_read_only) {
  Played played;
  EXPECT_EQ(played.ask("(function() string.rep = nil end)()"), "! console:1: the table string is read-only");
  EXPECT_EQ(played.ask("setmetatable(string, nil)"), "! console:1: cannot change a protected metatable");
  EXPECT_EQ(played.ask("getmetatable('')"), "string");
  EXPECT_EQ(played.ask("getmetatable('x').__index"), "nil");
  EXPECT_EQ(played.ask("rawset(string, 'rep', print) == string, ('x'):rep(3)"), "true\txxx")
      << "its own loss alone";
  Played other;
  EXPECT_EQ(other.ask("string.rep('x', 2)"), "xx");
}

}  // namespace
}  // namespace scree
