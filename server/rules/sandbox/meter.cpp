// What the running call has used. A hook looks every script_interval instructions, and functions of the
// library look where they take work off. Once the call is over, every look raises again, so that no pcall()
// keeps the script alive.
#include <algorithm>
#include <bit>
#include <cstring>

#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

void count_hook(lua_State* lua, lua_Debug*) {
  ScriptState& state = state_of(lua);
  state.work_left -= lua_gethookcount(lua);
  state.granted = 0;
  if (!look(state)) collect(lua);
  if (look(state)) raise_death(lua);
  set_interval(lua, state);
}

/// Instructions until the next look.
int interval_of(const ScriptState& state) {
  if (state.dead != ScriptDeath::none) return 1;
  for (size_t size = state.long_texts_by_size.size(); size-- > 0;)
    if (state.long_texts_by_size[size] > 0)
      return std::clamp(static_cast<int>(script_interval_bytes >> size), 1, script_interval);
  return script_interval;
}

/// Whether the thread's clock has passed the call's limit. The steady clock costs a tenth of the thread's,
/// and never runs slower.
bool is_late(ScriptState& state) {
  const double wall_s = steady_now_s();
  if (state.cpu_known_s + (wall_s - state.wall_known_s) < state.cpu_limit_s) return false;
  state.cpu_known_s = thread_cpu_s();
  state.wall_known_s = wall_s;
  return state.cpu_known_s >= state.cpu_limit_s;
}

/// Says why a call is over, where it stopped.
void tell_death(ScriptState& state, lua_State* lua) noexcept {
  if (state.death_told) return;
  state.death_told = true;
  state.fault = {};
  const bool memory = state.dead == ScriptDeath::out_of_memory;
  state.fault.kind = memory ? ScriptFault::Kind::out_of_memory : ScriptFault::Kind::too_long;
  std::string place;
  for (int level = 0; level < 4 && place.empty(); ++level) place = place_at(lua, level);
  state.fault.message = place + (memory ? "out of memory: " : "too long: ") + state.death_reason;
  fill_traceback(lua, 0, state.fault.traceback);
}

}  // namespace

ScriptState& state_of(lua_State* lua) noexcept {
  ScriptState* state = nullptr;
  std::memcpy(&state, lua_getextraspace(lua), sizeof state);
  return *state;
}

bool look(ScriptState& state) noexcept {
  if (state.dead != ScriptDeath::none) return true;
  if (state.work_left < 0)
    die(state, ScriptDeath::too_long, "the call has used the work that it was given");
  else if (is_late(state))
    die(state, ScriptDeath::too_long, "the call has used the time that it was given");
  return state.dead != ScriptDeath::none;
}

void die(ScriptState& state, ScriptDeath death, std::string_view reason) noexcept {
  if (state.dead != ScriptDeath::none) return;
  state.dead = death;
  state.death_reason = reason;
  hook_soon(state);
}

void hook_soon(ScriptState& state) noexcept {
  if (state.current == nullptr || lua_gethookcount(state.current) == 1) return;
  state.work_left -= lua_gethookcount(state.current);  // as many as may have run
  lua_sethook(state.current, count_hook, LUA_MASKCOUNT, 1);
}

void set_interval(lua_State* lua, ScriptState& state) noexcept {
  const int interval = interval_of(state);
  if (lua_gethookcount(lua) != interval || lua_gethook(lua) == nullptr)
    lua_sethook(lua, count_hook, LUA_MASKCOUNT, interval);
}

void raise_death(lua_State* lua) {
  tell_death(state_of(lua), lua);
  lua_pushliteral(lua, "the call is over");
  lua_error(lua);
  __builtin_unreachable();
}

void charge(lua_State* lua, int64_t work) {
  ScriptState& state = state_of(lua);
  state.work_left -= work;
  if (look(state)) raise_death(lua);
}

void charge_bytes(lua_State* lua, size_t bytes) {
  charge(lua, 1 + static_cast<int64_t>(bytes / script_bytes_per_work));
}

void raise_if_dead(lua_State* lua) {
  if (state_of(lua).dead != ScriptDeath::none) raise_death(lua);
}

void raise_here(lua_State* lua) {
  luaL_where(lua, 1);
  lua_insert(lua, -2);
  lua_concat(lua, 2);
  lua_error(lua);
  __builtin_unreachable();
}

bool begin_call(ScriptState& state, const ScriptBudget& budget) noexcept {
  CHECK(!state.running, "calls of a script do not nest");
  state.fault = {};
  state.dead = ScriptDeath::none;
  state.death_told = false;
  if (budget.work <= 0 || !(budget.cpu_s > 0)) {
    state.fault = {
        ScriptFault::Kind::too_long, "too long: calls before this one have used the whole budget", {}};
    return false;
  }
  std::vector<int> released;
  {
    const std::lock_guard lock(state.released->mutex);
    released.swap(state.released->slots);
  }
  for (const int slot : released) luaL_unref(state.lua, LUA_REGISTRYINDEX, slot);
  state.running = true;
  state.current = state.lua;
  state.work_given = state.work_left = std::min(budget.work, state.options.work_max);
  state.cpu_begin_s = state.cpu_known_s = thread_cpu_s();
  state.wall_known_s = steady_now_s();
  state.cpu_limit_s = state.cpu_begin_s + std::min(budget.cpu_s, state.options.cpu_max_s);
  set_interval(state.lua, state);
  return true;
}

void end_call(ScriptState& state, ScriptBudget& budget) noexcept {
  state.running = false;
  const int64_t work = std::max<int64_t>(state.work_given - state.work_left, 1);
  const double cpu_s = thread_cpu_s() - state.cpu_begin_s;
  budget.work -= work;
  budget.cpu_s -= cpu_s;
  state.work_used += work;
  state.cpu_used_s += cpu_s;
}

}  // namespace scree
