// Lua's basic functions. pcall() and its like look at the budget once the function has ended, however it did.
#include <algorithm>
#include <string_view>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/text.h"

namespace scree {

const char* push_text_of(lua_State* lua, int index, size_t* bytes) {
  index = lua_absindex(lua, index);
  const int type = lua_type(lua, index);
  const bool plain = type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING;
  if (!plain && luaL_getmetafield(lua, index, "__tostring") == LUA_TNIL) {
    if (luaL_getmetafield(lua, index, "__name") != LUA_TSTRING) lua_pushstring(lua, lua_typename(lua, type));
    return lua_tolstring(lua, -1, bytes);
  }
  if (!plain) lua_pop(lua, 1);
  return luaL_tolstring(lua, index, bytes);
}

namespace {

int base_tostring(lua_State* lua) {
  luaL_checkany(lua, 1);
  charge(lua, 2);
  push_text_of(lua, 1, nullptr);
  return 1;
}

void send_line(ScriptState& state, const char* text, size_t bytes) noexcept {
  if (state.options.print) state.options.print(showable({text, bytes}, script_print_bytes_max));
}

int base_print(lua_State* lua) {
  const int values = lua_gettop(lua);
  luaL_Buffer line;
  luaL_checkstack(lua, 8, "print");
  luaL_buffinit(lua, &line);
  for (int i = 1; i <= values && luaL_bufflen(&line) <= script_print_bytes_max; ++i) {
    if (i > 1) luaL_addchar(&line, ' ');
    push_text_of(lua, i, nullptr);
    luaL_addvalue(&line);
  }
  luaL_pushresult(&line);
  size_t bytes = 0;
  const char* text = lua_tolstring(lua, -1, &bytes);
  charge(lua, 20 + static_cast<int64_t>(bytes));
  send_line(state_of(lua), text, bytes);
  return 0;
}

int base_next(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  lua_settop(lua, 2);
  charge(lua, 3);  // looks at the clock, too: a step over many empty places takes long
  if (lua_next(lua, 1) != 0) return 2;
  lua_pushnil(lua);
  return 1;
}

int pairs_continued(lua_State*, int, lua_KContext) {
  return 3;
}

int base_pairs(lua_State* lua) {
  luaL_checkany(lua, 1);
  if (luaL_getmetafield(lua, 1, "__pairs") == LUA_TNIL) {
    lua_pushcfunction(lua, base_next);
    lua_pushvalue(lua, 1);
    lua_pushnil(lua);
  } else {
    lua_pushvalue(lua, 1);
    lua_callk(lua, 1, 3, 0, pairs_continued);
  }
  return 3;
}

/// After a protected call whose values lie above the first `skipped`.
int pcall_ended(lua_State* lua, int status, lua_KContext skipped) {
  raise_if_dead(lua);
  if (status == LUA_OK || status == LUA_YIELD) return lua_gettop(lua) - static_cast<int>(skipped);
  lua_pushboolean(lua, 0);
  lua_pushvalue(lua, -2);
  return 2;
}

int base_pcall(lua_State* lua) {
  luaL_checkany(lua, 1);
  charge(lua, 8);
  lua_pushboolean(lua, 1);
  lua_insert(lua, 1);
  return pcall_ended(lua, lua_pcallk(lua, lua_gettop(lua) - 2, LUA_MULTRET, 0, 0, pcall_ended), 0);
}

/// The handler lies first, `true` after it.
int xpcall_ended(lua_State* lua, int status, lua_KContext) {
  if (status == LUA_OK || status == LUA_YIELD) return pcall_ended(lua, status, 1);
  raise_if_dead(lua);
  lua_pushvalue(lua, 1);
  lua_insert(lua, -2);
  lua_pcall(lua, 1, 1, 0);
  raise_if_dead(lua);
  lua_pushboolean(lua, 0);
  lua_insert(lua, -2);
  return 2;
}

int base_xpcall(lua_State* lua) {
  luaL_checktype(lua, 2, LUA_TFUNCTION);
  charge(lua, 8);
  const int arguments = lua_gettop(lua) - 2;
  lua_pushvalue(lua, 2);
  lua_pushboolean(lua, 1);
  lua_rotate(lua, 1, 2);
  lua_remove(lua, 4);  // function, handler, …: handler, true, function, …
  return xpcall_ended(lua, lua_pcallk(lua, arguments, LUA_MULTRET, 0, 0, xpcall_ended), 0);
}

int base_setmetatable(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  const bool table = lua_istable(lua, 2);
  luaL_argexpected(lua, table || lua_type(lua, 2) == LUA_TNIL, 2, "nil or table");
  if (luaL_getmetafield(lua, 1, "__metatable") != LUA_TNIL)
    return luaL_error(lua, "cannot change a protected metatable");
  lua_settop(lua, 2);
  charge(lua, 2);
  if (table) {
    lua_pushliteral(lua, "__gc");
    if (lua_rawget(lua, 2) != LUA_TNIL) return luaL_error(lua, "__gc is not available here");
    lua_settop(lua, 2);
    note_metatable(lua, 2);
  }
  lua_setmetatable(lua, 1);
  return 1;
}

int base_collectgarbage(lua_State* lua) {
  if (std::string_view(luaL_optstring(lua, 1, "collect")) != "count")
    return luaL_error(lua, "collectgarbage(\"count\") alone is available here");
  lua_pushnumber(lua, static_cast<lua_Number>(state_of(lua).memory) / 1024);
  return 1;
}

/// Joins what a function gives, piece by piece, into one text.
int join_pieces(lua_State* lua) {
  luaL_Buffer whole;
  luaL_buffinit(lua, &whole);
  for (;;) {
    lua_pushvalue(lua, 1);
    lua_call(lua, 0, 1);
    size_t bytes = 0;
    const char* piece = lua_tolstring(lua, -1, &bytes);
    if (piece == nullptr && !lua_isnil(lua, -1)) {
      lua_pushliteral(lua, "reader function must return a string");
      luaL_where(lua, 2);  // 1 is load()
      lua_insert(lua, -2);
      lua_concat(lua, 2);
      lua_error(lua);
    }
    charge(lua, 16 + static_cast<int64_t>(bytes / script_bytes_per_work));
    if (bytes == 0) break;
    luaL_addvalue(&whole);
    if (luaL_bufflen(&whole) > script_file_bytes_max)
      luaL_error(lua, "a chunk is longer than %d bytes", static_cast<int>(script_file_bytes_max));
  }
  lua_pop(lua, 1);
  luaL_pushresult(&whole);
  return 1;
}

/// Leaves the text of a chunk, an argument of load(); or returns false with a message.
bool push_chunk(lua_State* lua) {
  if (lua_type(lua, 1) == LUA_TFUNCTION) lua_pushcfunction(lua, join_pieces);
  lua_pushvalue(lua, 1);
  if (lua_type(lua, 1) == LUA_TSTRING) return true;
  const int status = lua_pcall(lua, 1, 1, 0);
  raise_if_dead(lua);
  return status == LUA_OK;
}

int base_load(lua_State* lua) {
  const bool has_environment = lua_gettop(lua) >= 4;
  const bool is_text = lua_type(lua, 1) == LUA_TSTRING;
  if (!is_text) luaL_checktype(lua, 1, LUA_TFUNCTION);
  const char* chunk = luaL_optstring(lua, 2, is_text ? lua_tostring(lua, 1) : "=(load)");
  const std::string_view mode = luaL_optstring(lua, 3, "t");
  lua_settop(lua, 4);
  if (mode.find('t') == std::string_view::npos)
    return luaL_error(lua, "load: mode \"t\" (text) alone is available here");
  size_t bytes = 0;
  const char* text = push_chunk(lua) ? lua_tolstring(lua, -1, &bytes) : nullptr;
  if (text == nullptr || load_in_pieces(lua, {text, bytes}, chunk) != LUA_OK) {
    lua_pushnil(lua);
    lua_insert(lua, -2);
    return 2;
  }
  if (has_environment) {
    lua_pushvalue(lua, 4);
    if (lua_setupvalue(lua, -2, 1) == nullptr) lua_pop(lua, 1);
  }
  return 1;
}

/// What the reader of load_in_pieces() has left to give.
struct Pieces {
  std::string_view left;
};

const char* next_piece(lua_State* lua, void* of, size_t* bytes) {
  auto& pieces = *static_cast<Pieces*>(of);
  *bytes = std::min(pieces.left.size(), script_piece_bytes);
  charge(lua, static_cast<int64_t>(*bytes) * 2);
  const char* piece = pieces.left.data();
  pieces.left.remove_prefix(*bytes);
  return piece;
}

/// For messages of Lua, which looks for names there. A copy: a script's globals may be many.
void name_base_functions(lua_State* lua) {
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_libraries);
  lua_newtable(lua);
  lua_pushglobaltable(lua);
  const int globals = lua_gettop(lua);
  lua_pushnil(lua);
  while (lua_next(lua, globals) != 0) {
    lua_pushvalue(lua, -2);
    lua_insert(lua, -2);
    lua_rawset(lua, globals - 1);
  }
  lua_settop(lua, globals - 1);
  lua_setfield(lua, -2, "_G");
}

}  // namespace

int load_in_pieces(lua_State* lua, std::string_view text, const char* chunk) {
  Pieces pieces{text};
  const int status = lua_load(lua, next_piece, &pieces, chunk, "t");
  raise_if_dead(lua);
  return status;
}

void open_base(lua_State* lua) {
  static constexpr luaL_Reg functions[] = {{"tostring", base_tostring},
                                           {"print", base_print},
                                           {"next", base_next},
                                           {"pairs", base_pairs},
                                           {"pcall", base_pcall},
                                           {"xpcall", base_xpcall},
                                           {"setmetatable", base_setmetatable},
                                           {"collectgarbage", base_collectgarbage},
                                           {"load", base_load},
                                           {nullptr, nullptr}};
  static constexpr const char* absent[] = {"dofile", "loadfile", "warn"};
  lua_pushcfunction(lua, luaopen_base);
  lua_call(lua, 0, 1);
  set_functions(lua, functions);
  for (const char* name : absent) {
    lua_pushnil(lua);
    lua_setfield(lua, -2, name);
  }
  lua_pushglobaltable(lua);
  lua_getfield(lua, -1, "tonumber");
  lua_newtable(lua);
  lua_insert(lua, -2);
  lua_setfield(lua, -2, "tonumber");
  static constexpr const char* charged[] = {"tonumber", nullptr};
  adopt(lua, charged);
  name_base_functions(lua);
  lua_settop(lua, 0);
}

}  // namespace scree
