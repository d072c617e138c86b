// The library beside Lua's own: what is not said to differ is the same, messages included.
#include <algorithm>

#include "tests/rules/sandbox_support.h"
#include "tests/rules/stock_lua.h"

namespace scree {
namespace {

/// Each is a list of expressions.
const char* const questions_of_library[] = {
    "table.concat({1, 2, 'x'}, ', '), table.concat({}), table.concat({1, 2, 3}, '-', 2, 3), "
    "table.concat({1}, 'x', 3)",
    "pcall(table.concat, {1, {}, 3})",
    "pcall(table.concat, 1)",
    "(function() local t = {1, 2} table.insert(t, 3) table.insert(t, 1, 0) return table.concat(t, ',') "
    "end)()",
    "pcall(table.insert, {1}, 5, 1)",
    "pcall(table.insert, {1}, 0, 1)",
    "pcall(table.insert, {1})",
    "(function() local t = {1, 2, 3} local a, b = table.remove(t), table.remove(t, 1) return a, b, #t, t[1] "
    "end)()",
    "table.remove({}), table.remove({}, 0), table.remove({[0] = 'z'}, 0), table.remove({1, 2}, 3)",

    "table.concat(table.move({1, 2, 3}, 2, 3, 1), ','), table.concat(table.move({1, 2, 3}, 1, 3, 2), ',')",
    "table.concat(table.move({1, 2, 3}, 1, 3, 1, {9, 9, 9, 9}), ','), pcall(table.move, {}, 1, "
    "math.maxinteger, 2)",
    "pcall(table.move, {}, -1, math.maxinteger, 2)",
    "table.unpack({1, 2, nil, 4}, 1, 4)",
    "table.unpack({1, 2}, 2)",
    "table.unpack({}, 1, 0)",
    "pcall(table.unpack, {}, 1, 1e8)",
    "table.pack(1, nil, 3).n, table.pack().n",
    "(function() local t = {5, 3, 1, 4} table.sort(t) return table.concat(t, ',') end)()",
    "(function() local t = {5, 3, 1, 4} table.sort(t, function(a, b) return a > b end) return "
    "table.concat(t, ',') end)()",
    "(function() local t = {} for i = 1, 500 do t[i] = i * 7919 % 503 end table.sort(t) return "
    "table.concat(t, ',') end)()",
    "pcall(table.sort, {1, 'a'})",
    "pcall(table.sort, {1, 2}, 1)",
    "('x'):rep(3), ('x'):rep(0), ('x'):rep(-1), ('ab'):rep(3, ','), (''):rep(5), (''):rep(3, '-')",
    "('hello'):sub(2, -2), ('hello'):upper(), ('Hello'):lower(), ('abc'):reverse(), #'abc', ('abc'):len()",
    "('abc'):byte(1, -1)",
    "string.char(72, 105), pcall(string.char, 256)",
    "('%d %5.2f %s %q %x %5s %-5s| %c %i %g %%'):format(1, 2.5, 'x', 'a\\n\"', 255, 'r', 'l', 65, 3, 0.1)",
    "pcall(string.format, '%d', 1.5)",
    "pcall(string.format, '%d', 'x')",
    "pcall(string.format, '%y', 1)",
    "pcall(string.format, '%d')",
    "pcall(string.format, '%123d', 1)",
    "('%s %s %s'):format(nil, true, 1.0)",
    "('%q %q %q'):format(1, 0.5, math.mininteger)",
    "pcall(string.format, '%s')",
    "('%10.3s|'):format('abcdef')",
    "('%s'):format(setmetatable({}, {__tostring = function() return 'me' end}))",
    "pcall(tostring, setmetatable({}, {__tostring = function() return 1 end}))",
    "string.unpack('<i4', string.pack('<i4', -2))",
    "string.pack('z', 'abc'):byte(1, -1)",
    "string.pack('c5', 'abc'):byte(1, -1)",
    "string.packsize('<i4i8'), pcall(string.pack, 'c2', 'abc')",
    "tostring(1), tostring(1.0), tostring(nil), tostring(true), tostring('x'), tostring(1e100)",
    "tonumber('10'), tonumber('0x10'), tonumber('z', 36), tonumber('1e1'), tonumber(' 1 '), tonumber('x'), "
    "tonumber(nil)",
    "pcall(tonumber)",
    "pcall(tostring)",
    "tonumber('7', 8), tonumber('9', 8)",
    "'10' + 5, '3' * '4', 10 .. 20",
    "pcall(function() return 'a' + 1 end)",
    "pcall(function() return {} .. 'x' end)",
    "select('#', 1, nil), select(2, 'a', 'b', 'c'), pcall(select, 0)",
    "select(-1, 'a', 'b')",
    "next({}), next({10}), pcall(next, {}, 'x')",
    "rawequal('a', 'a'), rawlen({1, 2}), rawget({x = 1}, 'x')",
    "pcall(error, 'x'), pcall(error, {1}) == false",
    "pcall(error)",
    "select(2, pcall(error, 'x', 2))",
    "pcall(function() error('deep') end)",
    "pcall(function() local x = nil; x() end)",
    "pcall(function() undefined.x = 1 end)",
    "pcall(1)",
    "pcall(pcall)",
    "pcall(xpcall, print)",
    "xpcall(function(...) return ... end, print, 1, 2)",
    "xpcall(error, function(m) return m .. '!' end, 'x')",
    "xpcall(function() return 1 end, print)",
    "assert(1, 2), pcall(assert, false, 'no'), pcall(assert, nil)",
    "setmetatable({}, {__index = function(t, k) return k end}).abc",
    "pcall(setmetatable, 1, {})",
    "pcall(function() setmetatable({}, 1) end)",
    "pcall(setmetatable, {}, nil)",
    "pcall(setmetatable, setmetatable({}, {__metatable = 1}), {})",
    "getmetatable(setmetatable({}, {__metatable = 7}))",
    "type(1), type('x'), type({}), type(print), type(nil), type(coroutine.create(print))",
    "load('return 1 + 1')()",
    "load('x =')",
    "load('return ...', 'chunk')(7)",
    "load('return x', 'c', 't', {x = 9})()",
    "(function() local p = {'return ', '4', '2'} local i = 0 return load(function() i = i + 1 return p[i] "
    "end)() end)()",
    "load(function() return 1 < 2 end)",
    "pcall(function() load({}) end)",
    "(function() local c = coroutine.wrap(function(a) local b = coroutine.yield(a + 1) return b * 2 end) "
    "return c(1), c(10) end)()",
    "coroutine.resume(coroutine.create(function(...) return select('#', ...), ... end), 1, nil)",
    "coroutine.resume(coroutine.create(function() error('in') end))",
    "coroutine.resume(coroutine.create(function() error({}) end)) == false",
    "(function() local c = coroutine.create(type) coroutine.resume(c, 'x') return coroutine.resume(c) "
    "end)()",
    "pcall(coroutine.wrap(function() error('out') end))",
    "coroutine.isyieldable(), coroutine.status(coroutine.create(print))",
    "select(2, coroutine.running()), pcall(coroutine.resume, 1)",
    "pcall(coroutine.yield)",
    "coroutine.resume(coroutine.running())",
    "pcall(coroutine.create, 1)",
    "(function() local c c = coroutine.wrap(function() return pcall(c) end) return c() end)()",
    "coroutine.wrap(function() return pcall(function() coroutine.yield(1) error('late') end) end)()",
    "(function() local c = coroutine.wrap(function() return pcall(function() coroutine.yield(1) "
    "error('late') end) end) return c(), c() end)()",
    "(function() local c = coroutine.wrap(function() return xpcall(function() coroutine.yield(1) "
    "error('late') end, function(m) return m .. '?' end) end) return c(), c() end)()",
    "(function() local c = coroutine.wrap(function() return xpcall(function() return coroutine.yield(1), 3 "
    "end, print) end) return c(), c(2) end)()",
    "(function() local c = coroutine.wrap(function() for k in pairs(setmetatable({}, {__pairs = function() "
    "coroutine.yield(5) return next, {} end})) do end return 6 end) return c(), c() end)()",
    "(function() local n = 0 for k, v in pairs({1, 2, x = 3}) do n = n + v end return n end)()",
    "(function() local r = '' for i, v in ipairs({1, 2, nil, 4}) do r = r .. v end return r end)()",
    "(function() local r = '' do local c <close> = setmetatable({}, {__close = function() r = r .. 'c' end}) "
    "r = r .. 'b' end return r end)()",
    "math.floor(1.5), math.max(1, 2.5), math.type(1), math.type(1.0), math.tointeger(2.0), math.ult(1, -1), "
    "math.pi, math.huge",
    "7 // 2, 7 % -3, 2 ^ 10, 7 / 2, 1 << 62, ~0, 5 & 3, 1e15, 2^53",
    "pcall(math.floor, 'x')",
    "pcall(math.random, 2, 1)",
    "pcall(math.random, -1)",
    "pcall(math.random, 1, 2, 3)",
    "math.abs(math.mininteger), math.fmod(7, 3), pcall(math.fmod, 1, 0)",
    "utf8.char(228, 8364), utf8.len('äx'), utf8.codepoint('ä', 1), utf8.offset('äx', 2), utf8.len('\\xff')",
    "utf8.charpattern, (function() local r = '' for p, c in utf8.codes('aä') do r = r .. p .. c end return r "
    "end)()",
    "pcall(string.rep)",
    "pcall(('x').rep, 'x', {})",
    "pcall(string.sub)",
    "pcall(string.find, 'x')",
    "pcall(string.gsub, 'x', 'x')",
    "pcall(string.gsub, 'x', 'x', true)",
    "('abc'):find('b', -2), ('abc'):find('', 10), ('abc'):find('', 4)",
    "('abc'):find('c', 1, true), ('a.c'):find('.', 2, true), ('abc'):gmatch('b', 3)()",
    "('x'):gsub('x', 5), ('x'):gsub('', '-')",
};

/// All values of a list, with their types.
std::string joining(const std::string& list) {
  return "local function join(...) local r = {} for i = 1, select('#', ...) do local v = select(i, ...) "
         "r[i] = type(v) == 'string' and v or type(v) == 'table' and 'a table' or type(v) == 'function' and "
         "'a function' "
         "or math.type(v) and math.type(v) .. tostring(v) or type(v) == 'thread' and 'thread' or tostring(v) "
         "end return "
         "table.concat(r, '|') end return join(" +
         list + ")";
}

TEST(Library, gives_what_luas_own_gives) {
  Played played;
  StockLua stock;
  for (const char* list : questions_of_library)
    EXPECT_EQ(returned(played, joining(list)),
              stock.ask("function main() " + joining(list) + "\nend return (main())"))
        << list;
}

TEST(Library, has_the_names_that_luas_own_has) {
  Played played;
  StockLua stock;
  const std::string names =
      "local t = {} for _, name in ipairs({'string', 'table', 'math', 'coroutine', 'utf8', '_G'}) do "
      "for k in pairs(_G[name]) do t[#t + 1] = name .. '.' .. k end end table.sort(t) return table.concat(t, "
      "' ')";
  // Those of math are Debian's, of Lua 5.2.
  const auto all = [&](std::string text) {
    for (const char* gone :
         {"_G.io ", "_G.os ", "_G.debug ", "_G.package ", "_G.dofile ", "_G.loadfile ", "_G.warn ",
          "_G.main ", "string.dump ", "math.randomseed ", "math.atan2 ", "math.cosh ", "math.frexp ",
          "math.ldexp ", "math.log10 ", "math.pow ", "math.sinh ", "math.tanh ", "coroutine.close "})
      if (const size_t at = text.find(gone); at != std::string::npos)
        text.erase(at, std::string_view(gone).size());
    return text;
  };
  EXPECT_EQ(all(returned(played, names)), all(stock.ask(names)));
}

TEST(Library, remove_refuses_what_lies_outside) {
  Played played;
  for (const char* place : {"4", "0", "-1"})
    EXPECT_EQ(played.ask("table.remove({1, 2}, " + std::string(place) + ")"),
              "! console:1: bad argument #2 to 'remove' (position out of bounds)");
}

TEST(Library, random_numbers_follow_the_hosts_seed) {
  ScriptOptions options = small_options();
  options.random_seed = 7;
  Played first(options);
  Played second(options);
  const std::string draw = "math.random(), math.random(100), math.random(-5, 5), math.random(0)";
  const std::string drawn = first.ask(draw);
  EXPECT_EQ(drawn, second.ask(draw));
  EXPECT_NE(drawn, first.ask(draw));
  first.script.seed(7);
  EXPECT_EQ(drawn, first.ask(draw));
  EXPECT_EQ(first.ask("(function() local low, high = 9, 0 for i = 1, 1000 do local n = math.random(3, 6) low "
                      "= math.min(low, n) "
                      "high = math.max(high, n) end return low, high end)()"),
            "3\t6");
  EXPECT_EQ(first.ask("math.type(math.random(math.mininteger, math.maxinteger))"), "integer");
}

TEST(Library, sort_keeps_the_order_of_equals) {
  Played played;
  EXPECT_EQ(played.ask("(function() local t = {} for i = 1, 100 do t[i] = {i % 3, i} end table.sort(t, "
                       "function(a, b) return a[1] < b[1] end) "
                       "for i = 2, 100 do if t[i - 1][1] == t[i][1] and t[i - 1][2] > t[i][2] then return "
                       "false end end return true end)()"),
            "true");
}

}  // namespace
}  // namespace scree
