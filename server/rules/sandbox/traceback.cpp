#include "server/rules/sandbox/script_state.h"
#include "shared/base/text.h"

namespace scree {
namespace {

std::string function_text(const lua_Debug& at) {
  if (std::string_view(at.what) == "main") return "in main chunk";
  if (at.name != nullptr) {
    const std::string kind = at.namewhat != nullptr && *at.namewhat != 0 ? at.namewhat : "function";
    return "in " + kind + " '" + showable(at.name, 64) + "'";
  }
  if (std::string_view(at.what) == "C") return "in a function of the host";
  return "in function <" + showable(at.short_src, LUA_IDSIZE) + ":" + std::to_string(at.linedefined) + ">";
}

/// The text of the error itself; no code of the script is asked.
std::string message_of(lua_State* lua, int index) {
  if (lua_type(lua, index) == LUA_TSTRING || lua_type(lua, index) == LUA_TNUMBER) {
    lua_pushvalue(lua, index);
    size_t bytes = 0;
    const char* text = lua_tolstring(lua, -1, &bytes);
    std::string message = showable({text, bytes}, script_print_bytes_max);
    lua_pop(lua, 1);
    return message;
  }
  return std::string("an error that is a ") + luaL_typename(lua, index);
}

void note_message(ScriptState& state, lua_State* lua) noexcept {
  if (state.dead != ScriptDeath::none) return;
  state.fault = {};
  state.fault.message = message_of(lua, 1);
  fill_traceback(lua, 1, state.fault.traceback);
}

}  // namespace

std::string ScriptFault::text() const {
  std::string whole = message;
  for (const std::string& line : traceback) whole += "\n  " + line;
  return whole;
}

std::string place_at(lua_State* lua, int level) noexcept {
  lua_Debug at{};
  if (lua_getstack(lua, level, &at) == 0 || lua_getinfo(lua, "Sl", &at) == 0 || at.currentline <= 0)
    return {};
  return showable(at.short_src, LUA_IDSIZE) + ":" + std::to_string(at.currentline) + ": ";
}

void fill_traceback(lua_State* lua, int level, std::vector<std::string>& lines) noexcept {
  lines.clear();
  lua_Debug at{};
  for (; lines.size() < script_traceback_lines_max && lua_getstack(lua, level, &at) != 0; ++level) {
    if (lua_getinfo(lua, "Sln", &at) == 0) break;
    lines.push_back(place_at(lua, level) + function_text(at));
  }
}

int note_error(lua_State* lua) {
  note_message(state_of(lua), lua);
  return 1;
}

}  // namespace scree
