// Functions of the host in scripts. Between Lua and a BoundFunction lies run_bound(), which returns before an
// error of Lua is raised: by then all objects of the function are destroyed.
#include <exception>

#include "server/rules/sandbox/handles.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"

namespace scree {

struct BoundCall {
  /// The count of results, which lie on top of the stack; or -1 with a message there.
  static int run(ScriptState& state, lua_State* lua, const BoundFunction& function) noexcept;
};

namespace {

/// Leaves the hidden table of a global one, between calls.
void push_bound_table(lua_State* lua, std::string_view table) {
  if (table.empty()) {
    lua_pushglobaltable(lua);
    return;
  }
  const std::string name(table);
  push_library(lua, name.c_str());
}

void push_bound(ScriptState& state, BoundFunction function) {
  state.functions.push_back(std::move(function));
  lua_pushlightuserdata(state.lua, &state.functions.back());
  lua_pushcclosure(state.lua, call_bound, 1);
}

void check_between_calls(const ScriptState& state) {
  CHECK(!state.running, "functions are bound between calls");
}

}  // namespace

int take_written(ScriptState& state, lua_State* lua, const ScriptWriter& writer) noexcept {
  CHECK_EQ(lua_gettop(state.scratch), writer.count(), "each table that a function opens is closed");
  CHECK(lua_checkstack(lua, writer.count() + 4) != 0, "a call has a million values on the stack");
  lua_xmove(state.scratch, lua, writer.count());
  return writer.count();
}

ScriptCall::ScriptCall(ScriptState& state, lua_State* lua)
    : state_(state), lua_(lua), arguments_(lua_gettop(lua)), results_(state.scratch) {
  lua_settop(state.scratch, 0);
}

ScriptValue ScriptCall::argument(int number, std::string_view name) const {
  CHECK_GE(number, 1);
  std::string text = "argument " + std::to_string(number);
  if (!name.empty()) text += " (" + std::string(name) + ")";
  // What lies above the arguments is not theirs: an index that nothing can lie at.
  if (number > arguments_) number = LUAI_MAXSTACK - 1;
  return {lua_, number, std::move(text)};
}

int ScriptCall::arguments() const {
  return arguments_;
}

bool ScriptCall::charge(int64_t work) {
  state_.work_left -= work;
  return look(state_);
}

int BoundCall::run(ScriptState& state, lua_State* lua, const BoundFunction& function) noexcept {
  std::string message;
  try {
    ScriptCall call(state, lua);
    const Result<void> done = function(call);
    if (done) {
      return take_written(state, lua, call.results());
    }
    message = done.error().message;
  } catch (const std::exception& thrown) {
    message = std::string("the host failed: ") + thrown.what();
  } catch (...) {
    message = "the host failed";
  }
  CHECK(lua_checkstack(lua, 4) != 0);
  lua_pushlstring(lua, message.data(), message.size());
  return -1;
}

int call_bound(lua_State* lua) {
  const auto& function = *static_cast<const BoundFunction*>(lua_touserdata(lua, lua_upvalueindex(1)));
  const int results = BoundCall::run(state_of(lua), lua, function);
  raise_if_dead(lua);
  if (results < 0) raise_here(lua);
  return results;
}

void Script::define(std::string_view table, std::string_view name, BoundFunction function) {
  check_between_calls(*state_);
  lua_State* lua = state_->lua;
  push_bound_table(lua, table);
  lua_pushlstring(lua, name.data(), name.size());
  push_bound(*state_, std::move(function));
  lua_rawset(lua, -3);
  lua_settop(lua, 0);
}

void Script::define_method(std::string_view type, std::string_view name, BoundFunction function) {
  check_between_calls(*state_);
  lua_State* lua = state_->lua;
  push_methods(lua, type);
  lua_pushlstring(lua, name.data(), name.size());
  push_bound(*state_, std::move(function));
  lua_rawset(lua, -3);
  lua_settop(lua, 0);
}

void Script::take_vectors(std::string_view global) {
  check_between_calls(*state_);
  lua_State* lua = state_->lua;
  lua_pushglobaltable(lua);
  lua_pushlstring(lua, global.data(), global.size());
  CHECK_EQ(lua_rawget(lua, 1), LUA_TTABLE, "the metatable of vectors is a table");
  lua_pushliteral(lua, "__metatable");
  CHECK_NE(lua_rawget(lua, 2), LUA_TNIL, "scripts cannot reach the metatable of vectors");
  lua_settop(lua, 2);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_vectors);
  lua_pushlstring(lua, global.data(), global.size());
  lua_pushnil(lua);
  lua_rawset(lua, 1);
  lua_settop(lua, 0);
}

void Script::define_values(std::string_view table, const std::function<void(ScriptWriter& to)>& write) {
  check_between_calls(*state_);
  lua_State* lua = state_->lua;
  push_bound_table(lua, table);
  ScriptWriter writer(lua);
  writer.open_table();
  write(writer);
  writer.close_table();
  CHECK_EQ(lua_gettop(lua), 2, "the values of a table have names");
  lua_pushnil(lua);
  while (lua_next(lua, 2) != 0) {
    lua_pushvalue(lua, -2);
    lua_insert(lua, -2);
    lua_rawset(lua, 1);
  }
  lua_settop(lua, 0);
}

}  // namespace scree
