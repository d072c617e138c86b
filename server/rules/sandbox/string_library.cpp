// Lua's string and utf8 without patterns (pattern_library.cpp). What could make a large text is measured
// first.
#include <algorithm>
#include <cstring>
#include <string_view>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"

namespace scree {
namespace {

/// Raises where a function would make a text over the limit.
void check_text_bytes(lua_State* lua, size_t bytes, const char* function) {
  if (bytes > script_text_bytes_max)
    luaL_error(lua, "%s would make a string over %d bytes", function,
               static_cast<int>(script_text_bytes_max));
  charge_bytes(lua, bytes);
}

int string_rep(lua_State* lua) {
  size_t bytes = 0;
  size_t separator_bytes = 0;
  const char* text = luaL_checklstring(lua, 1, &bytes);
  const lua_Integer times = luaL_checkinteger(lua, 2);
  const char* separator = luaL_optlstring(lua, 3, "", &separator_bytes);
  if (times <= 0 || bytes + separator_bytes == 0) {
    lua_pushliteral(lua, "");
    return 1;
  }
  if (static_cast<size_t>(times) > script_text_bytes_max + 1) check_text_bytes(lua, SIZE_MAX, "string.rep");
  const auto count = static_cast<size_t>(times);
  check_text_bytes(lua, bytes * count + separator_bytes * (count - 1), "string.rep");
  charge(lua, times);
  luaL_Buffer made;
  luaL_buffinit(lua, &made);
  for (size_t i = 0; i < count; ++i) {
    if (i > 0) luaL_addlstring(&made, separator, separator_bytes);
    luaL_addlstring(&made, text, bytes);
  }
  luaL_pushresult(&made);
  return 1;
}

/// The conversion that begins at text[at], after '%'; the index of its letter.
size_t conversion_at(std::string_view text, size_t at) {
  while (at < text.size() && std::strchr("-+ #0123456789.", text[at]) != nullptr && text[at] != 0) ++at;
  return at;
}

/// Makes texts of the arguments of %s, so that no address is shown, and refuses %p.
void prepare_format(lua_State* lua, std::string_view format) {
  int argument = 1;
  for (size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') continue;
    i = conversion_at(format, i + 1);
    if (i >= format.size() || format[i] == '%') continue;
    ++argument;
    if (format[i] == 'p') luaL_error(lua, "%%p is not available here");
    if (format[i] != 's' || lua_isnone(lua, argument) || lua_isstring(lua, argument)) continue;
    push_text_of(lua, argument, nullptr);
    lua_replace(lua, argument);
  }
}

int string_format(lua_State* lua) {
  size_t bytes = 0;
  const char* format = luaL_checklstring(lua, 1, &bytes);
  luaL_checkstack(lua, 8, "string.format");
  charge_bytes(lua, bytes);
  prepare_format(lua, {format, bytes});
  for (int i = lua_gettop(lua); i > 1; --i)
    bytes += lua_type(lua, i) == LUA_TSTRING ? lua_rawlen(lua, i) : 16;
  check_text_bytes(lua, bytes, "string.format");
  charge(lua, static_cast<int64_t>(bytes / 2));
  return lua_tocfunction(lua, lua_upvalueindex(1))(lua);
}

/// Bytes that "c" with its numbers stand for, which are unbounded in a format.
size_t fixed_bytes(std::string_view format) {
  size_t all = 0;
  for (size_t i = 0; i < format.size(); ++i) {
    if (format[i] != 'c') continue;
    size_t bytes = 0;
    for (; i + 1 < format.size() && format[i + 1] >= '0' && format[i + 1] <= '9'; ++i)
      bytes = std::min(bytes * 10 + static_cast<size_t>(format[i + 1] - '0'), script_text_bytes_max + 1);
    all = std::min(all + bytes, script_text_bytes_max + 1);
  }
  return all;
}

int string_pack(lua_State* lua) {
  size_t bytes = 0;
  const char* format = luaL_checklstring(lua, 1, &bytes);
  const size_t fixed = fixed_bytes({format, bytes});
  bytes *= 16;  // of the widest option
  for (int i = lua_gettop(lua); i > 1; --i) bytes += lua_type(lua, i) == LUA_TSTRING ? lua_rawlen(lua, i) : 0;
  check_text_bytes(lua, bytes + fixed, "string.pack");
  charge(lua, static_cast<int64_t>(fixed));
  return lua_tocfunction(lua, lua_upvalueindex(1))(lua);
}

void set_string_metatable(lua_State* lua, int hidden) {
  lua_pushliteral(lua, "");
  lua_getmetatable(lua, -1);  // made by luaopen_string, with arithmetic on texts of numbers
  lua_pushvalue(lua, hidden);
  lua_setfield(lua, -2, "__index");
  lua_pushliteral(lua, "string");
  lua_setfield(lua, -2, "__metatable");
  lua_pop(lua, 2);
}

void open_utf8(lua_State* lua) {
  static constexpr const char* adopted[] = {"char", "codepoint", "codes", "len", "offset", nullptr};
  push_library(lua, "utf8");
  lua_pushcfunction(lua, luaopen_utf8);
  lua_call(lua, 0, 1);
  lua_getfield(lua, -1, "charpattern");
  lua_setfield(lua, -3, "charpattern");
  adopt(lua, adopted);
  lua_settop(lua, 0);
}

}  // namespace

void open_strings(lua_State* lua) {
  static constexpr const char* adopted[] = {"byte",    "char", "len",    "lower", "packsize",
                                            "reverse", "sub",  "unpack", "upper", nullptr};
  push_library(lua, "string");
  const int hidden = lua_gettop(lua);
  lua_pushcfunction(lua, string_rep);
  lua_setfield(lua, hidden, "rep");
  lua_pushcfunction(lua, luaopen_string);
  lua_call(lua, 0, 1);
  lua_getfield(lua, -1, "format");
  lua_pushcclosure(lua, string_format, 1);
  lua_setfield(lua, hidden, "format");
  lua_getfield(lua, -1, "pack");
  lua_pushcclosure(lua, string_pack, 1);
  lua_setfield(lua, hidden, "pack");
  adopt(lua, adopted);
  set_string_metatable(lua, hidden);
  lua_settop(lua, 0);
  open_utf8(lua);
}

}  // namespace scree
