#include "server/rules/sandbox/library.h"

#include "server/rules/sandbox/script_state.h"

namespace scree {

const char registry_libraries = 0;
const char registry_metatables = 0;
const char registry_scratch = 0;
const char registry_vectors = 0;

namespace {

/// A function of Lua's library, its upvalue, after a charge for its texts.
int call_adopted(lua_State* lua) {
  int64_t work = 1;
  for (int i = lua_gettop(lua); i > 0; --i)
    work += lua_type(lua, i) == LUA_TSTRING ? static_cast<int64_t>(lua_rawlen(lua, i) / script_bytes_per_work)
                                            : 1;
  charge(lua, work);
  return lua_tocfunction(lua, lua_upvalueindex(1))(lua);
}

int refuse_change(lua_State* lua) {
  return luaL_error(lua, "the table %s is read-only", lua_tostring(lua, lua_upvalueindex(1)));
}

/// pairs() of a read-only table goes through the hidden one.
int pairs_of_hidden(lua_State* lua) {
  lua_pushvalue(lua, lua_upvalueindex(2));
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_pushnil(lua);
  return 3;
}

/// next() that takes the hidden table in place of what it gets: the hidden table itself stays hidden.
int next_of_hidden(lua_State* lua) {
  charge(lua, 1);
  lua_settop(lua, 2);
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_replace(lua, 1);
  return lua_next(lua, 1) != 0 ? 2 : (lua_pushnil(lua), 1);
}

}  // namespace

void adopt(lua_State* lua, const char* const* names) {
  const int from = lua_gettop(lua);
  for (; *names != nullptr; ++names) {
    if (lua_getfield(lua, from, *names) != LUA_TFUNCTION) luaL_error(lua, "Lua has no function %s", *names);
    lua_pushcclosure(lua, call_adopted, 1);
    lua_setfield(lua, from - 1, *names);
  }
  lua_settop(lua, from - 1);
}

void set_functions(lua_State* lua, const luaL_Reg* functions) {
  luaL_setfuncs(lua, functions, 0);
}

void push_library(lua_State* lua, const char* name) {
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_libraries);
  lua_pushstring(lua, name);
  if (lua_rawget(lua, -2) == LUA_TTABLE) {
    lua_remove(lua, -2);
    return;
  }
  lua_pop(lua, 1);
  lua_newtable(lua);
  const int hidden = lua_gettop(lua);
  lua_pushstring(lua, name);
  lua_pushvalue(lua, hidden);
  lua_rawset(lua, hidden - 1);
  lua_newtable(lua);  // what scripts get
  lua_createtable(lua, 0, 4);
  lua_pushvalue(lua, hidden);
  lua_setfield(lua, -2, "__index");
  lua_pushstring(lua, name);
  lua_setfield(lua, -2, "__metatable");
  lua_pushstring(lua, name);
  lua_pushcclosure(lua, refuse_change, 1);
  lua_setfield(lua, -2, "__newindex");
  lua_pushvalue(lua, hidden + 1);
  lua_pushvalue(lua, hidden);
  lua_pushcclosure(lua, next_of_hidden, 1);
  lua_pushcclosure(lua, pairs_of_hidden, 2);
  lua_setfield(lua, -2, "__pairs");
  lua_setmetatable(lua, -2);
  lua_setglobal(lua, name);
  lua_remove(lua, hidden - 1);
}

int open_sandbox(lua_State* lua) {
  prepare_collection(lua);
  // Where Lua looks for the names of functions in its messages, too. Without the globals, which may be many.
  luaL_getsubtable(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_libraries);
  lua_newtable(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_types);
  lua_newtable(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_modules);
  state_of(lua).scratch = lua_newthread(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_scratch);
  open_base(lua);
  open_coroutines(lua);
  open_strings(lua);
  open_patterns(lua);
  open_tables(lua);
  open_math(lua);
  open_require(lua);
  return 0;
}

}  // namespace scree
