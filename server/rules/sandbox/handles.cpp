#include "server/rules/sandbox/handles.h"

#include <cstring>

#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"

namespace scree {

// By type's name: its metatable {__index = methods, __name = …, __metatable = name, __tostring}, and in it,
// under an address, the handles by number, weakly.
const char registry_types = 0;
const char registry_handles = 0;

namespace {

int handle_to_text(lua_State* lua) {
  lua_getiuservalue(lua, 1, 1);
  const auto* number = static_cast<const uint64_t*>(lua_touserdata(lua, 1));
  if (number == nullptr || lua_type(lua, -1) != LUA_TSTRING) return luaL_error(lua, "no handle");
  lua_pushfstring(lua, "%s %I", lua_tostring(lua, -1), static_cast<LUAI_UACINT>(*number));
  return 1;
}

/// Leaves a type's metatable, or nil.
bool push_type(lua_State* lua, std::string_view type) {
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_types);
  lua_pushlstring(lua, type.data(), type.size());
  const bool known = lua_rawget(lua, -2) == LUA_TTABLE;
  lua_remove(lua, -2);
  return known;
}

void set_field(lua_State* lua, int table, const char* key) {
  lua_pushstring(lua, key);
  lua_insert(lua, -2);
  lua_rawset(lua, table);
}

/// Leaves the new metatable.
void make_type(lua_State* lua, std::string_view type) {
  lua_newtable(lua);
  const int metatable = lua_gettop(lua);
  lua_newtable(lua);
  set_field(lua, metatable, "__index");
  lua_pushlstring(lua, type.data(), type.size());
  set_field(lua, metatable, "__name");
  lua_pushlstring(lua, type.data(), type.size());
  set_field(lua, metatable, "__metatable");
  lua_pushcfunction(lua, handle_to_text);
  set_field(lua, metatable, "__tostring");
  lua_newtable(lua);
  lua_newtable(lua);
  lua_pushliteral(lua, "v");
  set_field(lua, lua_gettop(lua) - 1, "__mode");
  lua_setmetatable(lua, -2);
  lua_rawsetp(lua, metatable, &registry_handles);
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_types);
  lua_pushlstring(lua, type.data(), type.size());
  lua_pushvalue(lua, metatable);
  lua_rawset(lua, -3);
  lua_pop(lua, 1);
}

}  // namespace

std::optional<ScriptHandle> handle_at(lua_State* lua, int index) {
  if (lua_type(lua, index) != LUA_TUSERDATA || lua_rawlen(lua, index) != sizeof(uint64_t))
    return std::nullopt;
  CHECK(lua_checkstack(lua, 4) != 0);
  ScriptHandle handle;
  const bool named = lua_getiuservalue(lua, index, 1) == LUA_TSTRING;
  if (named) handle.type = lua_tostring(lua, -1);
  lua_pop(lua, 1);
  if (!named) return std::nullopt;
  std::memcpy(&handle.number, lua_touserdata(lua, index), sizeof handle.number);
  return handle;
}

void push_handle(lua_State* lua, const ScriptHandle& handle) {
  CHECK(lua_checkstack(lua, 8) != 0);
  CHECK(push_type(lua, handle.type), "the type of a handle has a method");
  const int metatable = lua_gettop(lua);
  lua_rawgetp(lua, metatable, &registry_handles);
  const auto key = static_cast<lua_Integer>(handle.number);
  if (lua_rawgeti(lua, -1, key) != LUA_TUSERDATA) {
    lua_pop(lua, 1);
    std::memcpy(lua_newuserdatauv(lua, sizeof handle.number, 1), &handle.number, sizeof handle.number);
    lua_pushlstring(lua, handle.type.data(), handle.type.size());
    lua_setiuservalue(lua, -2, 1);
    lua_pushvalue(lua, metatable);
    lua_setmetatable(lua, -2);
    lua_pushvalue(lua, -1);
    lua_rawseti(lua, -3, key);
  }
  lua_replace(lua, metatable);
  lua_settop(lua, metatable);
}

void push_methods(lua_State* lua, std::string_view type) {
  if (!push_type(lua, type)) {
    lua_pop(lua, 1);
    make_type(lua, type);
  }
  lua_pushliteral(lua, "__index");
  lua_rawget(lua, -2);
  lua_remove(lua, -2);
}

}  // namespace scree
