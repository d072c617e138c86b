// string.find, match, gmatch and gsub on RE2. A compiled pattern is a userdata, which Lua frees with all
// else; its finalizer is the one that there is, and no code of a script. Some patterns are kept at hand by
// their text.
#include <cstring>
#include <new>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/pattern.h"
#include "server/rules/sandbox/script_state.h"

namespace scree {

const char registry_patterns = 0;

namespace {

/// The largest search, in items times bytes: 25 ms where it is as slow as it can be, with 30 captures like
/// (.-); most take a hundredth of that.
constexpr size_t search_size_max = size_t{1} << 20U;
constexpr size_t compile_work = 2000;

struct PatternBox {
  ScriptPattern* pattern;
};

/// What find() and its like run on. Trivial: it lives across errors.
struct Search {
  const ScriptPattern* pattern;
  std::string_view text;
  ScriptPattern::Match match;
};

int free_pattern(lua_State* lua) {
  auto* box = static_cast<PatternBox*>(lua_touserdata(lua, 1));
  if (box->pattern == nullptr) return 0;
  delete box->pattern;
  box->pattern = nullptr;
  free_outside(state_of(lua), script_pattern_memory_bytes);
  return 0;
}

/// Fills the box; else the reason is in state.text.
bool compile_into(ScriptState& state, PatternBox& box, std::string_view text, bool anchors) noexcept {
  Result<std::unique_ptr<ScriptPattern>> made = ScriptPattern::compile(text, anchors);
  if (!made) {
    state.text = made.error().message;
    return false;
  }
  box.pattern = made->release();
  hold_outside(state, script_pattern_memory_bytes);
  return true;
}

/// Forgets all patterns at hand where there are too many.
void make_place_for_pattern(lua_State* lua, int table) {
  int kept = 0;
  lua_pushnil(lua);
  for (; lua_next(lua, table) != 0; lua_pop(lua, 1)) ++kept;
  if (kept < script_patterns_kept) return;
  lua_newtable(lua);
  lua_pushvalue(lua, -1);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_patterns);
  lua_replace(lua, table);
}

/// Leaves the userdata of the pattern at an index of the stack. Raises where it is none.
const ScriptPattern* push_pattern(lua_State* lua, int index, bool anchors) {
  size_t bytes = 0;
  const char* text = luaL_checklstring(lua, index, &bytes);
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_patterns);
  const int table = lua_gettop(lua);
  lua_pushfstring(lua, anchors ? "a" : "n");
  lua_pushvalue(lua, index);
  lua_concat(lua, 2);
  lua_pushvalue(lua, -1);
  if (lua_rawget(lua, table) == LUA_TNIL) {
    lua_pop(lua, 1);
    charge(lua, static_cast<int64_t>(compile_work + bytes * 100));
    make_place_for_pattern(lua, table);
    auto* box = static_cast<PatternBox*>(lua_newuserdatauv(lua, sizeof(PatternBox), 0));
    box->pattern = nullptr;
    luaL_setmetatable(lua, "pattern");
    if (!compile_into(state_of(lua), *box, {text, bytes}, anchors)) {
      lua_pushlstring(lua, state_of(lua).text.data(), state_of(lua).text.size());
      raise_here(lua);
    }
    raise_if_dead(lua);
    lua_pushvalue(lua, -2);
    lua_pushvalue(lua, -2);
    lua_rawset(lua, table);
  }
  const ScriptPattern* pattern = static_cast<PatternBox*>(lua_touserdata(lua, -1))->pattern;
  lua_replace(lua, table);
  lua_settop(lua, table);
  return pattern;
}

/// Looks for the first match at or after a place, at a price. Raises where the budget is spent.
bool search(lua_State* lua, Search& to, size_t from) {
  const auto items = static_cast<size_t>(to.pattern->items()) + 1;
  const size_t left = to.text.size() - from;
  if (items * left > search_size_max)
    luaL_error(lua, "a pattern of %d characters is too long for a text of %d bytes", static_cast<int>(items),
               static_cast<int>(left));
  charge(lua, 8);
  const bool found = to.pattern->find(to.text, from, to.match);
  charge(lua, static_cast<int64_t>(items * ((found ? to.match.whole.end : to.text.size()) - from) / 4));
  return found;
}

void push_span(lua_State* lua, const Search& of, const ScriptPattern::Span& span) {
  lua_pushlstring(lua, of.text.data() + span.begin, span.end - span.begin);
}

void push_capture(lua_State* lua, const Search& of, int capture) {
  const ScriptPattern::Span& span = of.match.captures[capture];
  if (of.pattern->is_place(capture))
    lua_pushinteger(lua, static_cast<lua_Integer>(span.begin) + 1);
  else
    push_span(lua, of, span);
}

/// Its captures, or the whole match where the pattern has none.
int push_captures(lua_State* lua, const Search& of) {
  const int count = of.pattern->captures();
  luaL_checkstack(lua, count + 2, "too many captures");
  for (int i = 0; i < count; ++i) push_capture(lua, of, i);
  if (count == 0) push_span(lua, of, of.match.whole);
  return count == 0 ? 1 : count;
}

/// Where a search begins: a place in a text, negative ones from its end, from 0.
size_t begin_of(lua_Integer place, size_t bytes) {
  if (place > 0) return static_cast<size_t>(place) - 1;
  if (place == 0 || place < -static_cast<lua_Integer>(bytes)) return 0;
  return bytes - static_cast<size_t>(-place);
}

bool is_plain(std::string_view pattern) {
  return pattern.find_first_of("^$*+?.([%-") == std::string_view::npos;
}

/// Without a pattern: -1 where there is none.
lua_Integer find_plain(std::string_view text, size_t from, std::string_view wanted) noexcept {
  if (wanted.empty()) return static_cast<lua_Integer>(from);
  const void* found = memmem(text.data() + from, text.size() - from, wanted.data(), wanted.size());
  return found == nullptr ? -1 : static_cast<const char*>(found) - text.data();
}

int find_or_match(lua_State* lua, bool find) {
  size_t bytes = 0;
  size_t pattern_bytes = 0;
  const char* text = luaL_checklstring(lua, 1, &bytes);
  const char* pattern = luaL_checklstring(lua, 2, &pattern_bytes);
  const size_t from = begin_of(luaL_optinteger(lua, 3, 1), bytes);
  const bool plain = find && (lua_toboolean(lua, 4) != 0 || is_plain({pattern, pattern_bytes}));
  lua_settop(lua, 2);
  if (from > bytes) {
    lua_pushnil(lua);
    return 1;
  }
  if (plain) {
    charge_bytes(lua, bytes - from + pattern_bytes);
    const lua_Integer at = find_plain({text, bytes}, from, {pattern, pattern_bytes});
    if (at < 0) {
      lua_pushnil(lua);
      return 1;
    }
    lua_pushinteger(lua, at + 1);
    lua_pushinteger(lua, at + static_cast<lua_Integer>(pattern_bytes));
    return 2;
  }
  Search to{push_pattern(lua, 2, true), {text, bytes}, {}};
  if (!search(lua, to, from)) {
    lua_pushnil(lua);
    return 1;
  }
  if (!find) return push_captures(lua, to);
  lua_pushinteger(lua, static_cast<lua_Integer>(to.match.whole.begin) + 1);
  lua_pushinteger(lua, static_cast<lua_Integer>(to.match.whole.end));
  return 2 + (to.pattern->captures() > 0 ? push_captures(lua, to) : 0);
}

int string_find(lua_State* lua) {
  return find_or_match(lua, true);
}

int string_match(lua_State* lua) {
  return find_or_match(lua, false);
}

/// The next match that does not end where the last one did, which only an empty one can. `last_end` is -1 at
/// first.
bool search_next(lua_State* lua, Search& to, size_t from, lua_Integer last_end) {
  for (; from <= to.text.size(); ++from) {
    if (!search(lua, to, from)) return false;
    if (static_cast<lua_Integer>(to.match.whole.end) != last_end) return true;
    if (to.match.whole.begin > from) from = to.match.whole.begin;
    if (to.pattern->anchored()) return false;
  }
  return false;
}

/// Upvalues: text, pattern, where to go on, where the last match ended.
int next_match(lua_State* lua) {
  size_t bytes = 0;
  const char* text = lua_tolstring(lua, lua_upvalueindex(1), &bytes);
  const auto* box = static_cast<const PatternBox*>(lua_touserdata(lua, lua_upvalueindex(2)));
  Search to{box->pattern, {text, bytes}, {}};
  const auto from = static_cast<size_t>(lua_tointeger(lua, lua_upvalueindex(3)));
  if (from > bytes || !search_next(lua, to, from, lua_tointeger(lua, lua_upvalueindex(4)))) return 0;
  for (const int upvalue : {3, 4}) {
    lua_pushinteger(lua, static_cast<lua_Integer>(to.match.whole.end));
    lua_replace(lua, lua_upvalueindex(upvalue));
  }
  return push_captures(lua, to);
}

int string_gmatch(lua_State* lua) {
  size_t bytes = 0;
  luaL_checklstring(lua, 1, &bytes);
  luaL_checkstring(lua, 2);
  const size_t from = begin_of(luaL_optinteger(lua, 3, 1), bytes);
  lua_settop(lua, 2);
  push_pattern(lua, 2, false);
  lua_replace(lua, 2);
  lua_pushinteger(lua, static_cast<lua_Integer>(from));
  lua_pushinteger(lua, -1);
  lua_pushcclosure(lua, next_match, 4);
  return 1;
}

/// Adds the replacement text at 3, with its %1.
void add_text(lua_State* lua, luaL_Buffer* made, const Search& of) {
  size_t bytes = 0;
  const char* text = lua_tolstring(lua, 3, &bytes);
  for (size_t i = 0; i < bytes; ++i) {
    if (text[i] != '%') {
      luaL_addchar(made, text[i]);
      continue;
    }
    ++i;
    const char c = i < bytes ? text[i] : '\0';
    if (c == '%') {
      luaL_addchar(made, '%');
    } else if (c == '0' || (c == '1' && of.pattern->captures() == 0)) {
      luaL_addlstring(made, of.text.data() + of.match.whole.begin, of.match.whole.end - of.match.whole.begin);
    } else if (c >= '1' && c <= '9') {
      if (c - '1' >= of.pattern->captures())
        luaL_error(lua, "invalid capture index %%%d in replacement string", c - '0');
      push_capture(lua, of, c - '1');
      luaL_addvalue(made);
    } else {
      luaL_error(lua, "invalid use of '%%' in replacement string");
    }
  }
}

/// Adds what replaces a match: of a text, a table or a function.
void add_replacement(lua_State* lua, luaL_Buffer* made, const Search& of) {
  const int type = lua_type(lua, 3);
  if (type == LUA_TSTRING || type == LUA_TNUMBER) {
    charge_bytes(lua, lua_type(lua, 3) == LUA_TSTRING ? lua_rawlen(lua, 3) * 4 : 16);
    add_text(lua, made, of);
    return;
  }
  if (type == LUA_TFUNCTION) {
    lua_pushvalue(lua, 3);
    lua_call(lua, push_captures(lua, of), 1);
  } else {
    if (of.pattern->captures() > 0)
      push_capture(lua, of, 0);
    else
      push_span(lua, of, of.match.whole);
    lua_gettable(lua, 3);
  }
  if (lua_toboolean(lua, -1) == 0) {
    lua_pop(lua, 1);
    push_span(lua, of, of.match.whole);
  } else if (lua_isstring(lua, -1) == 0) {
    luaL_error(lua, "invalid replacement value (a %s)", luaL_typename(lua, -1));
  }
  luaL_addvalue(made);
}

int string_gsub(lua_State* lua) {
  size_t bytes = 0;
  const char* text = luaL_checklstring(lua, 1, &bytes);
  luaL_checkstring(lua, 2);
  const int type = lua_type(lua, 3);
  luaL_argexpected(lua,
                   type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TFUNCTION || type == LUA_TTABLE,
                   3, "string/function/table");
  const lua_Integer most = luaL_optinteger(lua, 4, static_cast<lua_Integer>(bytes) + 1);
  lua_settop(lua, 3);
  Search to{push_pattern(lua, 2, true), {text, bytes}, {}};
  luaL_Buffer made;
  luaL_buffinit(lua, &made);
  size_t from = 0;
  lua_Integer last_end = -1;
  lua_Integer count = 0;
  while (count < most && search_next(lua, to, from, last_end)) {
    ++count;
    luaL_addlstring(&made, text + from, to.match.whole.begin - from);
    add_replacement(lua, &made, to);
    from = to.match.whole.end;
    last_end = static_cast<lua_Integer>(from);
    if (luaL_bufflen(&made) > script_text_bytes_max)
      luaL_error(lua, "string.gsub would make a string over %d bytes",
                 static_cast<int>(script_text_bytes_max));
    if (to.pattern->anchored()) break;
  }
  luaL_addlstring(&made, text + from, bytes - from);
  luaL_pushresult(&made);
  lua_pushinteger(lua, count);
  return 2;
}

}  // namespace

void open_patterns(lua_State* lua) {
  static constexpr luaL_Reg functions[] = {{"find", string_find},
                                           {"match", string_match},
                                           {"gmatch", string_gmatch},
                                           {"gsub", string_gsub},
                                           {nullptr, nullptr}};
  luaL_newmetatable(lua, "pattern");
  lua_pushcfunction(lua, free_pattern);
  lua_setfield(lua, -2, "__gc");
  lua_newtable(lua);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, &registry_patterns);
  push_library(lua, "string");
  set_functions(lua, functions);
  lua_settop(lua, 0);
}

}  // namespace scree
