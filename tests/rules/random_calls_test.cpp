// Texts and calls by chance: nothing crashes, nothing overruns a limit.
#include "shared/base/random.h"
#include "tests/rules/sandbox_support.h"

namespace scree {
namespace {

constexpr std::string_view tokens[] = {"local ",
                                       "x",
                                       "y",
                                       " = ",
                                       "function ",
                                       "(",
                                       ")",
                                       " end ",
                                       "if ",
                                       " then ",
                                       " else ",
                                       "elseif ",
                                       "for ",
                                       "i = 1, 10 ",
                                       " do ",
                                       "while ",
                                       "true",
                                       "nil",
                                       "return ",
                                       "break ",
                                       "goto a ",
                                       "::a:: ",
                                       "{",
                                       "}",
                                       "[",
                                       "]",
                                       ".",
                                       ":",
                                       ",",
                                       ";",
                                       "'s'",
                                       "\"",
                                       "--",
                                       "[[",
                                       "]]",
                                       "1",
                                       "0x1p4",
                                       "1e309",
                                       "..",
                                       "...",
                                       "+",
                                       "-",
                                       "*",
                                       "//",
                                       "%",
                                       "^",
                                       "#",
                                       "~",
                                       "&",
                                       "<<",
                                       ">>",
                                       "==",
                                       "~=",
                                       "<",
                                       "and ",
                                       "or ",
                                       "not ",
                                       "<close>",
                                       "<const>",
                                       "_ENV",
                                       "string.rep",
                                       "pcall",
                                       "setmetatable",
                                       "\n",
                                       "\\",
                                       "\xff",
                                       "repeat ",
                                       " until ",
                                       "in pairs(_G)",
                                       "coroutine.wrap"};

TEST(RandomScripts, of_any_text_end) {
  ScriptOptions options = small_options();
  options.memory_max_bytes = size_t{1} << 20U;
  options.work_max = 20'000;
  Played played(options);
  Random random(1);
  int ended = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (uint32_t left = random.below(30); left > 0; --left)
      if (random.below(20) == 0)
        text += static_cast<char>(random.below(256));
      else
        text += tokens[random.below(static_cast<uint32_t>(std::size(tokens)))];
    ScriptBudget budget{1'000'000, 10};
    if (played.script.load_text("random", text, budget)) ++ended;
    ASSERT_LE(played.script.used().memory_most_bytes, size_t{4} << 20U) << text;
  }
  EXPECT_GT(ended, 200);
}

/// Calls functions of the library with values of a pool, which their results join.
constexpr const char* random_caller = R"(
  local functions = {}
  for _, name in ipairs({'string', 'table', 'math', 'coroutine', 'utf8', '_G'}) do
    for k, f in pairs(_G[name]) do
      if type(f) == 'function' and k ~= 'play' then functions[#functions + 1] = name .. '.' .. k end
    end
  end
  table.sort(functions)
  local by_name = {}
  for i, name in ipairs(functions) do
    local library, key = name:match('(.-)%.(.*)')
    by_name[i] = _G[library][key]
  end
  local random, pcall, pack, unpack, select, type, G = math.random, pcall, table.pack, table.unpack, select, type, _G
  local kept = {}
  for k, v in pairs(_G) do kept[k] = v end
  local pool
  local function fill()
    pool = {0, 1, -1, 2, 100, 65536, 1 << 31, math.maxinteger, math.mininteger, 0.5, -0.0, 1e308, math.huge, 0 / 0, '', 'a',
      'abc', '%d+', '(a*)(.-)', '[%w]', '%', '%s %d %q', '<i4', 'c99999', 'return 1', 'x = {', ('x'):rep(1000), ('\0'):rep(40000),
      true, false, {}, {1, 2, 3}, {x = 1}, setmetatable({}, {__index = function(t, k) return k end, __len = function() return 1 << 40 end}),
      setmetatable({}, {__call = print, __tostring = function() return ('y'):rep(500) end, __close = print}),
      function(...) return ... end, function() error('x') end, function() while true do end end,
      coroutine.create(function(...) while true do coroutine.yield(...) end end), coroutine.wrap(function() return 1 end), print, string, 'k', 'kv'}
  end
  fill()
  function play(calls)
    for k, v in next, kept do if G[k] ~= v then G[k] = v end end
    for i = 1, calls do
      local f = by_name[random(#by_name)]
      local arguments = {}
      local count = random(0, 4)
      for n = 1, count do if random(8) > 1 then arguments[n] = pool[random(#pool)] end end
      if random(10) == 1 then f = pool[random(#pool)] end
      local results = pack(pcall(f, unpack(arguments, 1, count)))
      for n = 2, results.n do
        local value = results[n]
        if value ~= nil and random(4) == 1 then pool[random(#pool)] = value end
      end
      if random(60) == 1 then fill() end
    end
  end
)";

TEST(RandomScripts, of_library_calls_stay_within_limits) {
  ScriptOptions options = small_options();
  options.memory_max_bytes = size_t{4} << 20U;
  options.work_max = 200'000;
  int whole = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    options.random_seed = seed;
    Played played(options);

    ASSERT_TRUE(played.run(random_caller));
    for (int i = 0; i < 60; ++i) {
      ScriptBudget budget{1'000'000, 10};
      const double begin_s = thread_cpu_s();
      const ScriptFunction play = played.script.global_function("play");
      if (!play) break;  // taken away by its own rawset
      const auto ended = played.script.call(
          play, [](ScriptWriter& to) { to.integer(100); }, budget);
      if (ended) ++whole;
      ASSERT_LE(thread_cpu_s() - begin_s, 1) << (ended ? "" : ended.error().text());
      ASSERT_LE(played.script.used().memory_most_bytes, size_t{12} << 20U)
          << (ended ? "" : ended.error().text());
    }
  }
  EXPECT_GT(whole, 20);
}

}  // namespace
}  // namespace scree
