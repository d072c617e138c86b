// Lua's table functions, with metamethods as in Lua, and work taken off item by item.
#include <algorithm>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"

namespace scree {
namespace {

constexpr int64_t item_work = 4;

lua_Integer checked_length(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  charge(lua, item_work);
  return luaL_len(lua, 1);
}

int table_concat(lua_State* lua) {
  lua_Integer last = checked_length(lua);
  size_t separator_bytes = 0;
  const char* separator = luaL_optlstring(lua, 2, "", &separator_bytes);
  lua_Integer i = luaL_optinteger(lua, 3, 1);
  last = luaL_optinteger(lua, 4, last);
  lua_settop(lua, 4);
  luaL_Buffer made;
  luaL_buffinit(lua, &made);
  for (bool first = true; i <= last; ++i, first = false) {
    if (!first) luaL_addlstring(&made, separator, separator_bytes);
    lua_geti(lua, 1, i);
    if (lua_isstring(lua, -1) == 0)
      luaL_error(lua, "invalid value (%s) at index %I in table for 'concat'", luaL_typename(lua, -1),
                 static_cast<LUAI_UACINT>(i));
    const auto bytes = static_cast<int64_t>(lua_rawlen(lua, -1) + separator_bytes);
    charge(lua, item_work + bytes / static_cast<int64_t>(script_bytes_per_work));
    luaL_addvalue(&made);
    if (luaL_bufflen(&made) > script_text_bytes_max)
      luaL_error(lua, "table.concat would make a string over %d bytes",
                 static_cast<int>(script_text_bytes_max));
    if (i == LUA_MAXINTEGER) break;
  }
  luaL_pushresult(&made);
  return 1;
}

int table_insert(lua_State* lua) {
  const lua_Integer end = static_cast<lua_Integer>(static_cast<lua_Unsigned>(checked_length(lua)) + 1);
  lua_Integer position = end;
  switch (lua_gettop(lua)) {
    case 2:
      break;
    case 3:
      position = luaL_checkinteger(lua, 2);
      luaL_argcheck(lua, static_cast<lua_Unsigned>(position) - 1U < static_cast<lua_Unsigned>(end), 2,
                    "position out of bounds");
      for (lua_Integer i = end; i > position; --i) {
        charge(lua, item_work);
        lua_geti(lua, 1, i - 1);
        lua_seti(lua, 1, i);
      }
      break;
    default:
      return luaL_error(lua, "wrong number of arguments to 'insert'");
  }
  lua_seti(lua, 1, position);
  return 0;
}

int table_remove(lua_State* lua) {
  const lua_Integer size = checked_length(lua);
  lua_Integer position = luaL_optinteger(lua, 2, size);
  lua_settop(lua, 2);
  if (position != size)
    luaL_argcheck(lua, static_cast<lua_Unsigned>(position) - 1U <= static_cast<lua_Unsigned>(size), 2,
                  "position out of bounds");
  lua_geti(lua, 1, position);
  for (; position < size; ++position) {
    charge(lua, item_work);
    lua_geti(lua, 1, position + 1);
    lua_seti(lua, 1, position);
  }
  lua_pushnil(lua);
  lua_seti(lua, 1, position);
  return 1;
}

int table_move(lua_State* lua) {
  const lua_Integer from = luaL_checkinteger(lua, 2);
  const lua_Integer end = luaL_checkinteger(lua, 3);
  const lua_Integer to = luaL_checkinteger(lua, 4);
  const int target = lua_isnoneornil(lua, 5) ? 1 : 5;
  luaL_checktype(lua, 1, LUA_TTABLE);
  luaL_checktype(lua, target, LUA_TTABLE);
  if (end >= from) {
    luaL_argcheck(lua, from > 0 || end < LUA_MAXINTEGER + from, 3, "too many elements to move");
    const lua_Integer count = end - from + 1;
    luaL_argcheck(lua, to <= LUA_MAXINTEGER - count + 1, 4, "destination wrap around");
    const bool forward =
        to > end || to <= from || (target != 1 && lua_compare(lua, 1, target, LUA_OPEQ) == 0);
    for (lua_Integer i = 0; i < count; ++i) {
      const lua_Integer item = forward ? i : count - 1 - i;
      charge(lua, item_work);
      lua_geti(lua, 1, from + item);
      lua_seti(lua, target, to + item);
    }
  }
  lua_pushvalue(lua, target);
  return 1;
}

int table_pack(lua_State* lua) {
  const int count = lua_gettop(lua);
  charge(lua, count);
  lua_createtable(lua, count, 1);
  lua_insert(lua, 1);
  for (int i = count; i >= 1; --i) lua_seti(lua, 1, i);
  lua_pushinteger(lua, count);
  lua_setfield(lua, 1, "n");
  return 1;
}

int table_unpack(lua_State* lua) {
  const lua_Integer from = luaL_optinteger(lua, 2, 1);
  const lua_Integer last = lua_isnoneornil(lua, 3) ? luaL_len(lua, 1) : luaL_checkinteger(lua, 3);
  if (from > last) return 0;
  const lua_Unsigned count = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(from);
  if (count >= script_block_bytes_max / 64 || lua_checkstack(lua, static_cast<int>(count) + 1) == 0)
    return luaL_error(lua, "too many results to unpack");
  raise_if_dead(lua);
  for (lua_Unsigned i = 0; i <= count; ++i) {
    charge(lua, 1);
    lua_geti(lua, 1, static_cast<lua_Integer>(static_cast<lua_Unsigned>(from) + i));
  }
  return static_cast<int>(count) + 1;
}

/// Whether the value on top belongs before the one below it; the function of order is argument 2, if any.
bool belongs_before(lua_State* lua) {
  int64_t work = item_work;
  if (lua_type(lua, -1) == LUA_TSTRING && lua_type(lua, -2) == LUA_TSTRING)
    work += static_cast<int64_t>(std::min(lua_rawlen(lua, -1), lua_rawlen(lua, -2)) / 2);
  charge(lua, work);
  if (lua_isnil(lua, 2)) return lua_compare(lua, -1, -2, LUA_OPLT) != 0;
  lua_pushvalue(lua, 2);
  lua_pushvalue(lua, -2);
  lua_pushvalue(lua, -4);
  lua_call(lua, 2, 1);
  const bool before = lua_toboolean(lua, -1) != 0;
  lua_pop(lua, 1);
  return before;
}

/// Merges [begin, middle) and [middle, end) of list `from` into `to`.
void merge(lua_State* lua, int from, int to, lua_Integer begin, lua_Integer middle, lua_Integer end) {
  lua_Integer left = begin;
  lua_Integer right = middle;
  for (lua_Integer out = begin; out < end; ++out) {
    bool take_right = left >= middle;
    if (left < middle && right < end) {
      lua_rawgeti(lua, from, left);
      lua_rawgeti(lua, from, right);
      take_right = belongs_before(lua);
      lua_pop(lua, 2);
    }
    charge(lua, item_work);
    lua_rawgeti(lua, from, take_right ? right++ : left++);
    lua_rawseti(lua, to, out);
  }
}

int table_sort(lua_State* lua) {
  const lua_Integer size = checked_length(lua);
  if (!lua_isnoneornil(lua, 2)) luaL_checktype(lua, 2, LUA_TFUNCTION);
  lua_settop(lua, 2);
  if (size < 2) return 0;
  luaL_argcheck(lua, size <= static_cast<lua_Integer>(script_block_bytes_max / 16), 1, "array too big");
  charge(lua, size * item_work);
  lua_createtable(lua, static_cast<int>(size), 0);
  lua_createtable(lua, static_cast<int>(size), 0);
  raise_if_dead(lua);
  for (lua_Integer i = 1; i <= size; ++i) {
    charge(lua, item_work);
    lua_geti(lua, 1, i);
    lua_rawseti(lua, 3, i);
  }
  int from = 3;
  for (lua_Integer width = 1; width < size; width *= 2) {
    const int to = 7 - from;  // 3, 4
    for (lua_Integer begin = 1; begin <= size; begin += 2 * width)
      merge(lua, from, to, begin, std::min(begin + width, size + 1), std::min(begin + 2 * width, size + 1));
    from = to;
  }
  for (lua_Integer i = 1; i <= size; ++i) {
    charge(lua, item_work);
    lua_rawgeti(lua, from, i);
    lua_seti(lua, 1, i);
  }
  return 0;
}

}  // namespace

void open_tables(lua_State* lua) {
  static constexpr luaL_Reg functions[] = {
      {"concat", table_concat}, {"insert", table_insert}, {"remove", table_remove}, {"move", table_move},
      {"pack", table_pack},     {"unpack", table_unpack}, {"sort", table_sort},     {nullptr, nullptr}};
  push_library(lua, "table");
  set_functions(lua, functions);
  lua_settop(lua, 0);
}

}  // namespace scree
