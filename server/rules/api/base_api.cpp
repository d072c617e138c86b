// What every script begins with: handlers, timers, the log.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "server/rules/api.h"
#include "server/rules/limits.h"
#include "server/rules/mod.h"

namespace scree {

namespace {

constexpr double longest_wait_s = 86400.0 * 365.0;

Result<Tick> ticks_of(const RulesCall& call, const ScriptValue& seconds) {
  const double s = TRY(seconds.number());
  if (!(s >= 0.0 && s <= longest_wait_s)) return seconds.refuse("a wait has 0 to 31,536,000 s");
  return std::max<Tick>(1, static_cast<Tick>(std::llround(s * call.mod.options().tick_rate_hz)));
}

Result<void> add_wait(RulesCall& call, bool repeats) {
  if (call.mod.timers() >= limits::timers_max)
    return fail("rules have " + std::to_string(limits::timers_max) + " timers at most");
  const Tick ticks = TRY(ticks_of(call, call.argument(1, "seconds")));
  ScriptFunction function = TRY(call.argument(2, "do").function());
  const uint64_t number = call.mod.add_timer(call.moment, ticks, repeats ? ticks : 0, std::move(function));
  call.results().integer(static_cast<int64_t>(number));
  return {};
}

Result<void> after(RulesCall& call) {
  return add_wait(call, false);
}

Result<void> every(RulesCall& call) {
  return add_wait(call, true);
}

Result<void> cancel(RulesCall& call) {
  const int64_t number = TRY(call.argument(1, "timer").integer());
  call.results().boolean(number > 0 && call.mod.remove_timer(static_cast<uint64_t>(number)));
  return {};
}

Result<void> log_line(RulesCall& call) {
  const ScriptValue text = call.argument(1, "text");
  if (text.is_number())
    call.mod.say(text.is_integer() ? std::to_string(TRY(text.integer()))
                                   : fmt::format("{:.14g}", TRY(text.number())));
  else
    call.mod.say(std::string(TRY(text.text())));
  return {};
}

template <size_t Index>
Result<void> add_handler(RulesCall& call) {
  if (call.mod.handlers().size() >= limits::handlers_max)
    return fail("rules have " + std::to_string(limits::handlers_max) + " handlers at most");
  call.mod.add_handler(api_events()[Index].name, TRY(call.argument(1, "do").function()));
  return {};
}

/// on.NAME for each event: a row each.
template <size_t... Index>
std::vector<ApiFunction> handler_rows(std::index_sequence<Index...>) {
  return {ApiFunction{.table = "on",
                      .name = api_events()[Index].name,
                      .arguments = "do: fun(e: event)",
                      .returns = "",
                      .what = api_events()[Index].what,
                      .example = api_events()[Index].example,
                      .run = add_handler<Index>,
                      .at_load = true}...};
}

constexpr ApiFunction base_rows[] = {
    {"", "after", "seconds: number, do: fun()", "integer",
     "Calls a function once, after so many seconds of the world. The number is for `cancel`. It is forgotten "
     "at "
     "a restart: keep when something is due by `store.set`.",
     "after(0.5, function() log(\"half a second later\") end)", after, true},
    {"", "every", "seconds: number, do: fun()", "integer", "Calls a function again and again.",
     "local beat = every(1, function() log(\"a second\") end)", every, true},
    {"", "cancel", "timer: integer", "boolean", "Takes a timer away. False: there is none of that number.",
     "local t = after(1, function() end)\nassert(cancel(t) and not cancel(t))", cancel, true},
    {"", "log", "text: string|number", "",
     "Writes a line to the server's log, as `print` does. Ten a second are written; the others are counted.",
     "log(\"the world stands at tick \" .. world.tick())", log_line, true},
};

}  // namespace

std::span<const ApiFunction> base_api() {
  static const std::vector<ApiFunction> all = [] {
    std::vector<ApiFunction> rows = handler_rows(std::make_index_sequence<api_event_count>{});
    rows.insert(rows.end(), std::begin(base_rows), std::end(base_rows));
    return rows;
  }();
  return all;
}

std::vector<ApiFunction> all_api() {
  std::vector<ApiFunction> all;
  for (const std::span<const ApiFunction> part :
       {base_api(), world_api(), body_api(), region_api(), person_api(), show_api(), store_api()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace scree
