// Scripts that attack the server that runs them: each call ends within its budget, the world goes on, and
// honest persons see nothing. Times are processor time of the simulation's thread, with room for slow
// machines.
#include <chrono>
#include <ctime>
#include <gtest/gtest.h>

#include "server/formats/world_value.h"
#include "server/rules/rules.h"
#include "tests/support/rules_world.h"

namespace scree {
namespace {

double attacked_thread_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct RuleAttack {
  const char* name;
  const char* text;
  bool faults = true;  ///< it is ended; else it does no harm
};

class RulesAttack : public ::testing::TestWithParam<RuleAttack> {};

TEST_P(RulesAttack, ticks_stay_in_time_and_an_honest_mod_goes_on) {
  RulesWorld game(
      std::vector<std::string>{"on.tick(function(e) store.set('ticks', e.tick) end)", GetParam().text});
  game.join("anna");
  double worst_s = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double begin_s = attacked_thread_s();
    TickCommands commands({});
    game.rules->before(*game.world, commands);
    worst_s = std::max(worst_s, attacked_thread_s() - begin_s);
    const auto through = commands.let_through();
    const auto delta = game.world->step(through);
    game.rules->after(*delta);
    ASSERT_EQ(delta->ledger.error(), 0);
    ASSERT_LE(through.size(), limits::rules_commands_max + 1);
  }
  // All rules may take half of a tick's 16.7 ms here; a call may end a few ms later.
  EXPECT_LT(worst_s, 0.08);
  EXPECT_EQ(game.rules->faults() > 0, GetParam().faults) << game.all_logged();
  bool goes_on = false;
  for (const KeptValue& one : *game.world->game().kept)
    goes_on |= one.key == "first/ticks" && one.value == "11";
  EXPECT_TRUE(goes_on);
}

INSTANTIATE_TEST_SUITE_P(
    All, RulesAttack,
    ::testing::Values(
        RuleAttack{"endless_loop", "on.tick(function() while true do end end)"},
        RuleAttack{"endless_loop_in_pcall",
                   "on.tick(function() while true do pcall(function() while true do end end) end end)"},
        RuleAttack{"endless_loop_in_a_coroutine",
                   "on.tick(function() coroutine.wrap(function() while true do end end)() end)"},
        RuleAttack{"deep_recursion",
                   "on.tick(function() local function f(n) return 1 + f(n + 1) end f(1) end)"},
        RuleAttack{"long_text", "on.tick(function() local s = 'x'; while true do s = s .. s end end)"},
        RuleAttack{"a_gigabyte", "on.tick(function() local s = string.rep('x', 2 ^ 30) end)"},
        RuleAttack{
            "repeated_text",
            "on.tick(function() local t = {}; for i = 1, 1e9 do t[i] = ('x'):rep(60000) .. i end end)"},
        RuleAttack{
            "pattern_bomb",
            "on.tick(function() local s = ('a'):rep(30000); while true do s:find(('a*'):rep(20) .. 'b') "
            "end end)"},
        RuleAttack{
            "metatables",
            "on.tick(function() local t = {}; for i = 1, 1e7 do t = setmetatable({}, { __index = t }) end; "
            "return t.x end)"},
        RuleAttack{
            "coroutines",
            "on.tick(function() local t = {}; for i = 1, 1e6 do t[i] = coroutine.create(print) end end)"},
        RuleAttack{"throws_in_each_tick", "on.tick(function() error({}) end)"},
        RuleAttack{
            "ten_thousand_bodies",
            "on.tick(function() for i = 1, 10000 do bodies.add{ box = vec(1, 1, 1), at = vec(i % 50, 5, "
            "0) } end "
            "end)"},
        RuleAttack{"a_flood_of_messages",
                   "on.tick(function() for i = 1, 1e6 do message.send('c', ('x'):rep(4096)) end end)"},
        RuleAttack{"a_flood_of_lines", "on.tick(function() for i = 1, 1e6 do print(i) end end)"},
        RuleAttack{"a_flood_of_values",
                   "on.tick(function() for i = 1, 1e6 do store.set('k' .. i, ('x'):rep(9000)) end end)"},
        RuleAttack{"timers", "on.tick(function() for i = 1, 1e6 do after(1, function() end) end end)"},
        RuleAttack{"handlers", "on.tick(function() for i = 1, 1e6 do on.tick(function() end) end end)"},
        RuleAttack{
            "questions",
            "on.tick(function() for i = 1, 1e6 do world.ray(vec(0, 5, 0), vec(0, -1, 0), 100) end end)"},
        RuleAttack{"sorts",
                   "on.tick(function() local t = {}; for i = 1, 20000 do t[i] = -i end; while true do "
                   "table.sort(t, function(a, b) return true end) end end)"},
        RuleAttack{"globals_of_the_host", "world = nil; on = nil; print = nil", false}),
    [](const ::testing::TestParamInfo<RuleAttack>& attack) { return attack.param.name; });

}  // namespace
}  // namespace scree
