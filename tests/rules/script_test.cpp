#include "server/rules/sandbox/script.h"

#include <stdexcept>

#include "tests/rules/sandbox_support.h"

namespace scree {
namespace {

TEST(ScriptCalls, a_function_gets_arguments_and_gives_results) {
  Played played;
  ASSERT_TRUE(played.run("function add(at, more) return at.x + at.y + more[2], 'sum' end"));
  ScriptBudget budget{100'000, 1};
  double sum = 0;
  std::string text;
  const auto ended = played.script.call(
      played.script.global_function("add"),
      [](ScriptWriter& to) {
        to.open_table();
        to.name("x");
        to.number(1.5);
        to.name("y");
        to.integer(2);
        to.close_table();
        to.open_table();
        to.integer(7);
        to.integer(8);
        to.close_table();
      },
      budget,
      [&](const std::vector<ScriptValue>& results) -> Result<void> {
        sum = TRY(results.at(0).number());
        text = TRY(results.at(1).text());
        return {};
      });
  ASSERT_TRUE(ended) << ended.error().text();
  EXPECT_EQ(sum, 11.5);
  EXPECT_EQ(text, "sum");
}

TEST(ScriptCalls, a_bound_function_reads_while_it_writes) {
  Played played;
  played.script.define("world", "sizes", [](ScriptCall& call) -> Result<void> {
    const ScriptValue boxes = call.argument(1, "boxes");
    call.results().open_table();
    for (int64_t i = 1; i <= TRY(boxes.length()); ++i) {
      const ScriptValue box = TRY(boxes.item(i));
      call.results().number(TRY(TRY(box.field("size")).number()));
    }
    call.results().close_table();
    call.results().boolean(true);
    return {};
  });
  EXPECT_EQ(played.ask("world.sizes({{size = 2}, {size = 3.5}})"), "{2.0, 3.5}\ttrue");
  EXPECT_EQ(played.ask("world.sizes({{size = 2}, {size = 'x'}})"),
            "! console:1: argument 1 (boxes)[2].size is a string, not a number");
  EXPECT_EQ(played.ask("world.sizes()"), "! console:1: argument 1 (boxes) is nil, not a table");
}

TEST(ScriptCalls, what_a_bound_function_throws_is_an_error_of_the_script) {
  Played played;
  played.script.define("", "fall",
                       [](ScriptCall&) -> Result<void> { throw std::runtime_error("no bridge"); });
  EXPECT_EQ(played.ask("fall()"), "! console:1: the host failed: no bridge");
  EXPECT_EQ(played.ask("select(2, pcall(fall))"), "the host failed: no bridge");
}

TEST(ScriptCalls, objects_of_a_bound_function_are_gone_before_its_error_is_raised) {
  Played played;
  const auto witness = std::make_shared<int>(1);
  played.script.define("", "refuse", [&](ScriptCall&) -> Result<void> {
    const std::shared_ptr<int> copy = witness;
    return fail("a reason of some length, so that the text lies on the heap " + std::to_string(*copy));
  });
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(played.run("refuse()"));
  EXPECT_EQ(witness.use_count(), 1);
}

TEST(ScriptCalls, a_kept_function_lives_until_it_is_let_go_of) {
  Played played;
  ScriptFunction kept;
  played.script.define("", "on_blast", [&](ScriptCall& call) -> Result<void> {
    kept = TRY(call.argument(1, "handler").function());
    return {};
  });
  ASSERT_TRUE(played.run(
      "local big = {} for i = 1, 20000 do big[i] = i end on_blast(function(n) last = big[n] end)"));
  ScriptBudget budget{1'000'000, 1};
  ASSERT_TRUE(played.script.call(
      kept, [](ScriptWriter& to) { to.integer(5); }, budget));
  EXPECT_EQ(played.ask("last"), "5");
  const size_t held = played.script.used().memory_bytes;
  kept = {};
  EXPECT_EQ(played.ask("(function() local t = {} for i = 1, 40 do t[i] = ('xxxxxxxxxx'):rep(5000) .. i t[i] "
                       "= 0 end end)()"),
            "");
  EXPECT_LT(played.script.used().memory_bytes + 200'000, held);
}

TEST(ScriptCalls, a_kept_function_may_outlive_its_script) {
  ScriptFunction kept;
  {
    Played played;
    ASSERT_TRUE(played.run("function f() end"));
    kept = played.script.global_function("f");
  }
  EXPECT_TRUE(kept);
}

TEST(ScriptCalls, handles_have_methods_and_are_equal_by_number) {
  Played played;
  played.script.define_method("person", "name", [](ScriptCall& call) -> Result<void> {
    call.results().text("person " + std::to_string(TRY(call.argument(1, "self").handle("person"))));
    return {};
  });
  played.script.define_method("prop", "name", [](ScriptCall&) -> Result<void> { return {}; });
  played.script.define("world", "person", [](ScriptCall& call) -> Result<void> {
    call.results().handle({"person", static_cast<uint64_t>(TRY(call.argument(1, "number").integer()))});
    return {};
  });
  played.script.define("world", "prop", [](ScriptCall& call) -> Result<void> {
    call.results().handle({"prop", 5});
    return {};
  });
  EXPECT_EQ(played.ask("world.person(5):name()"), "person 5");
  EXPECT_EQ(played.ask("world.person(5) == world.person(5), world.person(5) == world.person(6)"),
            "true\tfalse");
  EXPECT_EQ(
      played.ask("(function() local t = {} t[world.person(-1)] = 'me' return t[world.person(-1)] end)()"),
      "me");
  EXPECT_EQ(played.ask("tostring(world.person(7)), getmetatable(world.person(7))"), "person 7\tperson");
  EXPECT_EQ(played.ask("world.person(5)"), "person 5");
  EXPECT_EQ(played.ask("world.person(5).name(world.prop())"),
            "! console:1: argument 1 (self) is a prop, not a person");
  EXPECT_EQ(played.ask("world.person(5).name({})"),
            "! console:1: argument 1 (self) is a table, not a person");
}

TEST(ScriptCalls, bound_tables_hold_constants_and_cannot_be_changed) {
  Played played;
  played.script.define_values("world", [](ScriptWriter& to) {
    to.name("size");
    to.integer(64);
    to.name("materials");
    to.open_table();
    to.text("rock");
    to.close_table();
  });
  EXPECT_EQ(played.ask("world.size, world.materials[1]"), "64\trock");
  EXPECT_EQ(played.ask("(function() world.size = 1 end)()"), "! console:1: the table world is read-only");
  EXPECT_EQ(played.ask("getmetatable(world)"), "world");
  EXPECT_EQ(played.ask("(function() local n = 0 for k in pairs(world) do n = n + 1 end return n end)()"),
            "2");
}

TEST(ScriptFaults, name_file_and_line_and_the_way_there) {
  Played played;
  ASSERT_TRUE(played.run(
      "function inner(x)\n  return x.y.z\nend\nfunction outer(x)\n  local v = inner(x)\n  return v\nend"));
  ScriptBudget budget{100'000, 1};
  const auto ended = played.script.call(
      played.script.global_function("outer"), [](ScriptWriter& to) { to.open_table(), to.close_table(); },
      budget);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().kind, ScriptFault::Kind::error);
  EXPECT_EQ(ended.error().message, "test:2: attempt to index a nil value (field 'y')");
  ASSERT_EQ(ended.error().traceback.size(), 2U) << ended.error().text();
  EXPECT_EQ(ended.error().traceback[0], "test:2: in global 'inner'");
  EXPECT_EQ(ended.error().traceback[1], "test:5: in function <test:4>");
}

TEST(ScriptFaults, of_syntax_name_the_line) {
  Played played;
  EXPECT_EQ(fault_of(played, "x = 1\ny = = 2").message, "test:2: unexpected symbol near '='");
}

TEST(ScriptFaults, of_tables_as_errors_are_said) {
  Played played;
  EXPECT_EQ(fault_of(played, "error({code = 1})").message, "an error that is a table");
  EXPECT_EQ(fault_of(played, "error()").message, "an error that is a nil");
}

TEST(ScriptFaults, say_where_a_call_was_too_long) {
  Played played;
  const ScriptFault fault = fault_of(played, "local n = 0\nwhile true do\n  n = n + 1\nend");
  EXPECT_EQ(fault.kind, ScriptFault::Kind::too_long);
  EXPECT_TRUE(fault.message.starts_with("test:")) << fault.message;
  EXPECT_NE(fault.message.find("too long: the call has used the work that it was given"), std::string::npos);
  EXPECT_FALSE(fault.traceback.empty());
}

TEST(ScriptFaults, of_a_call_leave_the_script_as_it_was_before_its_last_step) {
  Played played;
  EXPECT_EQ(fault_of(played, "n = 0 while true do n = n + 1 end").kind, ScriptFault::Kind::too_long);
  EXPECT_EQ(played.ask("n > 1000"), "true");
}

TEST(ScriptBudgets, are_shared_by_calls) {
  Played played;
  ASSERT_TRUE(played.run("function spin(n) for i = 1, n do end end"));
  const ScriptFunction spin = played.script.global_function("spin");
  ScriptBudget budget{50'000, 10};
  int calls = 0;
  while (played.script.call(
      spin, [](ScriptWriter& to) { to.integer(10'000); }, budget))
    ++calls;
  EXPECT_GE(calls, 4);
  EXPECT_LE(calls, 5);
  EXPECT_LE(budget.work, 0);
  EXPECT_LT(budget.cpu_s, 10);
  const auto ended = played.script.call(
      spin, [](ScriptWriter& to) { to.integer(1); }, budget);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().message, "too long: calls before this one have used the whole budget");
}

TEST(ScriptBudgets, count_work_about_by_instructions) {
  Played played;
  ASSERT_TRUE(played.run("function spin(n) for i = 1, n do end end"));
  const int64_t before = played.script.used().work;
  ScriptBudget budget{1'000'000, 10};
  ASSERT_TRUE(played.script.call(
      played.script.global_function("spin"), [](ScriptWriter& to) { to.integer(500'000); }, budget));
  EXPECT_NEAR(static_cast<double>(played.script.used().work - before), 500'000, 2'000);
  EXPECT_NEAR(static_cast<double>(budget.work), 500'000, 2'000);
}

TEST(ScriptBudgets, end_a_call_by_the_threads_clock) {
  ScriptOptions options = small_options();
  options.work_max = 100'000'000'000;
  options.cpu_max_s = 0.02;
  Played played(options);
  const double begin_s = thread_cpu_s();
  ScriptBudget budget{100'000'000'000, 10};
  const auto ended = played.script.load_text("test", "while true do end", budget);
  const double took_s = thread_cpu_s() - begin_s;
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().kind, ScriptFault::Kind::too_long);
  EXPECT_GE(took_s, 0.02);
  EXPECT_LE(took_s, 0.03);
  EXPECT_NEAR(budget.cpu_s, 10 - took_s, 0.01);
}

TEST(ScriptBudgets, are_charged_by_bound_functions) {
  Played played;
  bool spent = false;
  played.script.define("", "dig", [&](ScriptCall& call) -> Result<void> {
    spent = call.charge(600'000);
    return {};
  });
  ASSERT_TRUE(played.run("dig()"));
  EXPECT_FALSE(spent);
  EXPECT_EQ(fault_of(played, "dig() dig() after = true").kind, ScriptFault::Kind::too_long);
  EXPECT_TRUE(spent);
  EXPECT_EQ(played.ask("after"), "nil");
}

TEST(ScriptMemory, freed_after_a_call_that_had_too_much) {
  ScriptOptions options = small_options();
  options.work_max = 20'000'000;
  Played played(options);
  const ScriptFault fault =
      fault_of(played, "local t = {} for i = 1, 1e9 do t[i % 60000] = {i, i + 1} .. nil end");
  EXPECT_EQ(fault.kind, ScriptFault::Kind::error);
  const ScriptFault memory =
      fault_of(played, "local t = {} for i = 1, 1e5 do t[#t % 60000 + 1] = {i, {i}, {i}} end");
  EXPECT_EQ(memory.kind, ScriptFault::Kind::out_of_memory);
  EXPECT_NE(
      memory.message.find("its values take more than its 8388608 bytes; what it no longer needs is freed"),
      std::string::npos)
      << memory.message;
  EXPECT_LT(played.script.used().memory_bytes, 200'000U);
  EXPECT_LT(played.script.used().memory_most_bytes, 10U << 20U);
}

TEST(ScriptMemory, garbage_alone_never_fills_it) {
  ScriptOptions options = small_options();
  options.work_max = 20'000'000;
  Played played(options);
  const auto ended = played.run(
      "local keep = {} for i = 1, 20000 do keep[i] = {i} end "
      "for i = 1, 300000 do local t = {i, i} end");
  EXPECT_TRUE(ended) << ended.error().text();
  EXPECT_LT(played.script.used().memory_most_bytes, 6U << 20U);
}

TEST(ScriptMemory, garbage_of_short_calls_is_freed_between_them) {
  Played played;
  ASSERT_TRUE(played.run("function tick() local t = {1, 2, 3} return {t, t} end"));
  const ScriptFunction tick = played.script.global_function("tick");
  for (int i = 0; i < 50'000; ++i) {
    ScriptBudget budget{1000, 1};
    const auto ended = played.script.call(tick, nullptr, budget);
    ASSERT_TRUE(ended) << ended.error().text();
  }
  EXPECT_LT(played.script.used().memory_most_bytes, 2U << 20U);
}

TEST(ScriptMemory, a_long_text_that_nobody_needs_slows_nothing_down_for_long) {
  Played played;
  ASSERT_TRUE(played.run("for i = 1, 3 do local s = ('xxxxxxxxxx'):rep(6000) end"));
  EXPECT_EQ(played.ask("collectgarbage('count') > 60"), "true");
  EXPECT_EQ(played.ask("(function() for i = 1, 400000 do end return collectgarbage('count') < 60 end)()"),
            "true");
}

TEST(ScriptConsole, shows_values_and_runs_statements) {
  Played played;
  EXPECT_EQ(played.ask("1 + 1, 'a', nil, 1.5"), "2\ta\tnil\t1.5");
  EXPECT_EQ(played.ask("x = {1, 2, name = 'n', [true] = {}}"), "");
  EXPECT_EQ(played.ask("x"), "{1, 2, [true] = {}, name = \"n\"}");
  EXPECT_EQ(played.ask("for i = 1, 3 do print(i, x) end"), "");
  EXPECT_EQ(played.lines, (std::vector<std::string>{"1 table", "2 table", "3 table"}));
  EXPECT_EQ(played.ask("x ="), "! console:1: unexpected symbol near <eof>");
  EXPECT_EQ(played.ask("(function() local t = {} t[1] = t return t end)()"), "{{{{…}}}}");
}

TEST(ScriptConsole, lines_of_print_can_be_shown) {
  Played played;
  ASSERT_TRUE(played.run("print('a\\27[31m\\0b\\xff') print(('x'):rep(5000)) print()"));
  ASSERT_EQ(played.lines.size(), 3U);
  EXPECT_EQ(played.lines[0], "a [31m b?");
  EXPECT_LE(played.lines[1].size(), 1024U);
  EXPECT_EQ(played.lines[2], "");
}

TEST(ScriptOptionsAre, checked) {
  ScriptOptions options = small_options();
  options.memory_max_bytes = 1000;
  EXPECT_EQ(Script::create(options).error().message,
            "the memory of script test is 1000 bytes; it must be 262144 to 268435456");
  options = small_options();
  options.folder = "/no/such/folder";
  EXPECT_EQ(Script::create(options).error().message, "script test has no folder /no/such/folder");
  options = small_options();
  options.work_max = 0;
  EXPECT_EQ(Script::create(options).error().message, "the work of a call of script test must be above 0");
}

}  // namespace
}  // namespace scree
