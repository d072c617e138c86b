#include "server/rules/sandbox/display.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "server/rules/sandbox/handles.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/text.h"

namespace scree {
namespace {

constexpr int display_depth = 3;
constexpr size_t display_items = 32;

std::string number_text(lua_State* lua, int index) {
  lua_pushvalue(lua, index);
  std::string text = lua_tostring(lua, -1);
  lua_pop(lua, 1);
  return text;
}

std::string userdata_text(lua_State* lua, int index) {
  const auto handle = handle_at(lua, index);
  if (!handle) return "(userdata)";
  return std::string(handle->type) + " " + std::to_string(static_cast<int64_t>(handle->number));
}

bool is_name(std::string_view text) {
  const auto in_name = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && in_name(text[0]) &&
         std::ranges::all_of(text, [&](char c) { return in_name(c) || (c >= '0' && c <= '9'); });
}

std::string display_value(lua_State* lua, int index, int depth, bool inner);

std::string display_key(lua_State* lua, int index) {
  if (lua_type(lua, index) == LUA_TSTRING) {
    const std::string_view key = lua_tostring(lua, index);
    if (is_name(key)) return std::string(key);
  }
  return "[" + display_value(lua, index, 0, true) + "]";
}

std::string display_table(lua_State* lua, int index, int depth) {
  if (depth == 0 || lua_checkstack(lua, 4) == 0) return "{…}";
  std::string list;
  size_t items = 0;
  const auto length = static_cast<size_t>(lua_rawlen(lua, index));
  for (size_t i = 1; i <= length && i <= display_items; ++i, ++items) {
    lua_rawgeti(lua, index, static_cast<lua_Integer>(i));
    list += (list.empty() ? "" : ", ") + display_value(lua, lua_gettop(lua), depth - 1, true);
    lua_pop(lua, 1);
  }
  std::vector<std::string> rest;
  lua_pushnil(lua);
  while (lua_next(lua, index) != 0) {
    const int value = lua_gettop(lua);
    const bool listed = lua_isinteger(lua, value - 1) != 0 && lua_tointeger(lua, value - 1) >= 1 &&
                        static_cast<size_t>(lua_tointeger(lua, value - 1)) <= length;
    if (!listed && ++items <= display_items)
      rest.push_back(display_key(lua, value - 1) + " = " + display_value(lua, value, depth - 1, true));
    lua_pop(lua, 1);
  }
  std::ranges::sort(rest);
  for (const std::string& pair : rest) list += (list.empty() ? "" : ", ") + pair;
  if (items > display_items || length > display_items) list += ", …";
  return "{" + list + "}";
}

std::string display_value(lua_State* lua, int index, int depth, bool inner) {
  switch (lua_type(lua, index)) {
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(lua, index) != 0 ? "true" : "false";
    case LUA_TNUMBER:
      return number_text(lua, index);
    case LUA_TSTRING: {
      size_t bytes = 0;
      const char* text = lua_tolstring(lua, index, &bytes);
      const std::string shown = showable({text, bytes}, script_print_bytes_max);
      return inner ? "\"" + shown + "\"" : shown;
    }
    case LUA_TTABLE:
      return display_table(lua, index, depth);
    case LUA_TUSERDATA:
      return userdata_text(lua, index);
    default:
      return std::string("(") + luaL_typename(lua, index) + ")";
  }
}

}  // namespace

std::string display_values(lua_State* lua) {
  std::string all;
  const int values = lua_gettop(lua);
  for (int i = 1; i <= values && all.size() < script_print_bytes_max; ++i) {
    if (i > 1) all += '\t';
    all += display_value(lua, i, display_depth, false);
  }
  if (all.size() <= script_print_bytes_max) return all;
  return showable(all, script_print_bytes_max) + "…";
}

}  // namespace scree
