// Memory of a script. Beyond its limits a block is granted nevertheless, and the call ends at the next
// instruction: if it were refused, Lua would collect all garbage at each try, without a hook.
//
// Collection is ours, too: Lua's own is stopped. Tables with weak keys cost the collector quadratic time in a
// part that cannot be interrupted (16,000 entries: 0.6 s), so collect() looks for them before each step that
// it has Lua take.
#include <algorithm>
#include <bit>
#include <cstdlib>

#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// Texts of this size and more shorten the interval.
constexpr size_t long_text_bytes = script_interval_bytes / script_interval;

/// One step marks or sweeps 20,000 values, 0.1 ms.
constexpr int step_factor_percent = 40;
constexpr size_t step_granted_bytes = size_t{16} << 10U;
/// A long text slows the script down, also one that nobody needs. So while there is one, steps and cycles go
/// on where nothing is granted, too: a step is a fifth of the time between two.
constexpr int looks_between_steps = 4096;
constexpr int looks_between_cycles = 65536;
/// The end of a call counts as so many looks.
constexpr int looks_of_call = 512;
/// A new block counts this, beside its bytes: it must be found, marked and freed. So steps of collection are
/// paid for before they are due, and a call with a small budget does not end for the garbage of others.
constexpr int64_t block_work = 12;

void forget_long_text(ScriptState& state, const void* block, size_t bytes) {
  if (bytes < long_text_bytes || state.long_texts.erase(block) == 0) return;
  --state.long_texts_by_size[static_cast<size_t>(std::bit_width(bytes))];
}

void note_long_text(ScriptState& state, const void* block, size_t bytes) {
  const auto size = static_cast<size_t>(std::bit_width(bytes));
  if (bytes < long_text_bytes || size >= state.long_texts_by_size.size()) return;
  state.long_texts.insert(block);
  ++state.long_texts_by_size[size];
  state.long_text_is_new = true;
  hook_soon(state);
}

/// Once the block is granted: ends the call where it is too much, asks for a look where it is time.
void count_grant(ScriptState& state, size_t bytes, size_t block_bytes, bool is_text) {
  state.memory_most = std::max(state.memory_most, state.memory);
  state.granted += bytes;
  state.granted_since_step += bytes;
  state.granted_since_full += bytes;
  if (state.memory_limit == SIZE_MAX) return;
  state.work_left -= static_cast<int64_t>(bytes / script_bytes_per_work);
  const size_t overhead = 64;  // of Lua's texts
  if (is_text && block_bytes > script_text_bytes_max + overhead)
    die(state, ScriptDeath::out_of_memory,
        "a text is longer than " + std::to_string(script_text_bytes_max) + " bytes");
  else if (block_bytes > script_block_bytes_max)
    die(state, ScriptDeath::out_of_memory,
        "a table (or the stack of calls) is larger than " + std::to_string(script_block_bytes_max) +
            " bytes");
  else if (state.memory > state.memory_limit)
    die(state, ScriptDeath::out_of_memory,
        "its values take more than its " + std::to_string(state.memory_limit) + " bytes");
  else if (state.granted > script_interval_granted_bytes || state.work_left < 0 ||
           (state.memory > state.memory_limit - state.memory_limit / 16 &&
            state.granted_since_full > state.memory_limit / 16))
    hook_soon(state);
}

bool has_weak_keys(lua_State* lua, int metatable) {
  lua_pushliteral(lua, "__mode");
  const bool has = lua_rawget(lua, metatable) == LUA_TSTRING;
  std::string_view mode;
  if (has) mode = lua_tostring(lua, -1);
  const bool weak = mode.find('k') != std::string_view::npos && mode.find('v') == std::string_view::npos;
  lua_pop(lua, 1);
  return weak;
}

/// Takes the mode from metatables that have weak keys; returns how many it looked at, and notes what it
/// found.
int64_t strengthen(lua_State* lua, bool& found) {
  int64_t seen = 0;
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_metatables);
  lua_pushnil(lua);
  while (lua_next(lua, -2) != 0) {
    ++seen;
    const int metatable = lua_gettop(lua);
    if (has_weak_keys(lua, metatable)) {
      found = true;
      lua_pushliteral(lua, "__mode");
      lua_pushnil(lua);
      lua_rawset(lua, metatable);
    }
    lua_pop(lua, 1);
  }
  lua_pop(lua, 1);
  return seen;
}

void set_next_cycle(ScriptState& state) {
  const size_t room = state.memory < state.memory_limit ? state.memory_limit - state.memory : 0;
  state.collect_at = state.memory + std::min(room / 2, state.memory + script_memory_min_bytes);
  state.collecting = false;
  state.looks_since_cycle = 0;
}

void count_looks(ScriptState& state, int looks) {
  state.looks_since_step = std::min(state.looks_since_step + looks, looks_between_steps);
  state.looks_since_cycle = std::min(state.looks_since_cycle + looks, looks_between_cycles);
}

/// Whether a full collection is due, or steps are.
enum class Due : uint8_t { nothing, steps, all };

Due due(const ScriptState& state) {
  const size_t margin = state.memory_limit / 16;
  if (state.memory > state.memory_limit - margin && state.granted_since_full > margin) return Due::all;
  const bool cycle = state.collecting || state.memory >= state.collect_at || state.long_text_is_new ||
                     (!state.long_texts.empty() && state.looks_since_cycle >= looks_between_cycles);
  const size_t granted_max = std::max(step_granted_bytes, state.granted_per_step);
  const bool waits = state.granted_since_step < granted_max && state.looks_since_step < looks_between_steps;
  return cycle && !waits ? Due::steps : Due::nothing;
}

/// Returns whether a metatable had weak keys.
bool take_steps(ScriptState& state, lua_State* lua, Due what) {
  bool found = false;
  const int64_t seen = strengthen(lua, found);
  if (what == Due::all) {
    lua_gc(lua, LUA_GCCOLLECT);
    state.granted_since_full = 0;
    set_next_cycle(state);
  } else {
    // What is new now, the cycle after this one finds.
    if (!state.collecting) state.long_text_is_new = false;
    state.collecting = true;
    // More steps at a time where there is much to look at before them.
    for (int64_t steps = 1 + seen / 1000; steps > 0 && state.collecting; --steps)
      if (lua_gc(lua, LUA_GCSTEP, 0) != 0) set_next_cycle(state);
  }
  state.granted_since_step = 0;
  state.looks_since_step = 0;
  state.granted_per_step = step_granted_bytes * static_cast<size_t>(1 + seen / 1000);
  return found;
}

}  // namespace

void* allocate_for_script(void* of, void* block, size_t old_bytes, size_t bytes) noexcept {
  ScriptState& state = *static_cast<ScriptState*>(of);
  const bool is_text = block == nullptr && old_bytes == LUA_TSTRING;
  if (block == nullptr) {
    old_bytes = 0;
    state.work_left -= block_work;
  }
  forget_long_text(state, block, old_bytes);
  if (bytes == 0) {
    std::free(block);
    state.memory -= old_bytes;
    return nullptr;
  }
  void* granted = std::realloc(block, bytes);
  CHECK(granted != nullptr, "this machine has no memory left");
  state.memory = state.memory - old_bytes + bytes;
  if (is_text) note_long_text(state, granted, bytes);
  if (bytes > old_bytes) count_grant(state, bytes - old_bytes, bytes, is_text);
  return granted;
}

void hold_outside(ScriptState& state, size_t bytes) noexcept {
  state.memory += bytes;
  count_grant(state, bytes, bytes, false);
}

void free_outside(ScriptState& state, size_t bytes) noexcept {
  state.memory -= bytes;
}

int prepare_collection(lua_State* lua) {
  lua_gc(lua, LUA_GCINC, 0, step_factor_percent, 0);
  lua_gc(lua, LUA_GCSTOP);
  lua_newtable(lua);
  lua_createtable(lua, 0, 1);
  lua_pushliteral(lua, "v");
  lua_setfield(lua, -2, "__mode");
  lua_setmetatable(lua, -2);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_metatables);
  return 0;
}

void collect(lua_State* lua) {
  ScriptState& state = state_of(lua);
  count_looks(state, 1);
  const Due what = due(state);
  if (what == Due::nothing || !take_steps(state, lua, what)) return;
  lua_pushliteral(lua,
                  "a metatable with weak keys (__mode = \"k\") is not available here; \"v\" and \"kv\" are");
  raise_here(lua);
}

void collect_after_call(ScriptState& state) noexcept {
  count_looks(state, looks_of_call);
  const Due what = due(state);
  if (what != Due::nothing) take_steps(state, state.lua, what);
}

void collect_all(ScriptState& state) noexcept {
  bool found = false;
  strengthen(state.lua, found);
  lua_gc(state.lua, LUA_GCCOLLECT);
  state.granted_since_full = 0;
  set_next_cycle(state);
}

void note_metatable(lua_State* lua, int index) {
  const int metatable = lua_absindex(lua, index);
  if (has_weak_keys(lua, metatable))
    luaL_error(lua, "weak keys (__mode = \"k\") are not available here; \"v\" and \"kv\" are");
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_metatables);
  lua_pushvalue(lua, metatable);
  lua_rawsetp(lua, -2, lua_topointer(lua, metatable));
  lua_pop(lua, 1);
}

}  // namespace scree
