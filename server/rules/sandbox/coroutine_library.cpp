// Coroutines. A resume counts as a whole interval: a coroutine that ends within one would otherwise count
// nothing, and coroutines in coroutines would multiply that.
#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"

namespace scree {
namespace {

constexpr int64_t create_work = 64;

int coroutine_create(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TFUNCTION);
  charge(lua, create_work);
  lua_State* made = lua_newthread(lua);
  lua_pushvalue(lua, 1);
  lua_xmove(lua, made, 1);
  return 1;
}

/// Resumes with the `arguments` on top of the stack. The count of results there, or -1 with the error.
int resume(lua_State* lua, lua_State* coroutine, int arguments) {
  ScriptState& state = state_of(lua);
  charge(lua, lua_gethookcount(coroutine) + arguments + 8);
  if (lua_checkstack(coroutine, arguments) == 0) {
    lua_pushliteral(lua, "too many arguments to resume");
    return -1;
  }
  lua_xmove(lua, coroutine, arguments);
  state.current = coroutine;
  set_interval(coroutine, state);
  int results = 0;
  const int status = lua_resume(coroutine, lua, arguments, &results);
  state.current = lua;
  set_interval(lua, state);
  raise_if_dead(lua);
  if (status != LUA_OK && status != LUA_YIELD) {
    lua_xmove(coroutine, lua, 1);
    return -1;
  }
  if (lua_checkstack(lua, results + 1) == 0) {
    lua_pop(coroutine, results);
    lua_pushliteral(lua, "too many results to resume");
    return -1;
  }
  lua_xmove(coroutine, lua, results);
  return results;
}

int coroutine_resume(lua_State* lua) {
  lua_State* coroutine = lua_tothread(lua, 1);
  luaL_argexpected(lua, coroutine != nullptr, 1, "thread");
  const int results = resume(lua, coroutine, lua_gettop(lua) - 1);
  lua_pushboolean(lua, results < 0 ? 0 : 1);
  lua_insert(lua, -(results < 0 ? 2 : results + 1));
  return results < 0 ? 2 : results + 1;
}

/// A wrapped coroutine, its upvalue. Unlike Lua's, it leaves variables of a failed coroutine unclosed: their
/// handlers would run without a hook.
int call_wrapped(lua_State* lua) {
  const int results = resume(lua, lua_tothread(lua, lua_upvalueindex(1)), lua_gettop(lua));
  if (results >= 0) return results;
  if (lua_type(lua, -1) == LUA_TSTRING) raise_here(lua);
  return lua_error(lua);
}

int coroutine_wrap(lua_State* lua) {
  coroutine_create(lua);
  lua_pushcclosure(lua, call_wrapped, 1);
  return 1;
}

}  // namespace

void open_coroutines(lua_State* lua) {
  static constexpr luaL_Reg functions[] = {{"create", coroutine_create},
                                           {"resume", coroutine_resume},
                                           {"wrap", coroutine_wrap},
                                           {nullptr, nullptr}};
  static constexpr const char* adopted[] = {"isyieldable", "running", "status", nullptr};
  push_library(lua, "coroutine");
  set_functions(lua, functions);
  lua_pushcfunction(lua, luaopen_coroutine);
  lua_call(lua, 0, 1);
  lua_getfield(lua, -1, "yield");
  lua_setfield(lua, -3, "yield");
  adopt(lua, adopted);
  lua_settop(lua, 0);
}

}  // namespace scree
