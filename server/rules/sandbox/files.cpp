// Files of a script's folder, and require().
#include <algorithm>
#include <filesystem>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/regular_file.h"
#include "shared/base/text.h"

namespace scree {

const char registry_modules = 0;

namespace {

bool is_file_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == '/';
}

/// Relative to the folder, with ".lua".
Result<std::string> checked_path(std::string_view name) {
  if (name.empty() || name.size() > script_path_bytes_max)
    return fail("a name of a file has 1 to " + std::to_string(script_path_bytes_max) + " characters");
  if (!std::ranges::all_of(name, is_file_character))
    return fail("\"" + showable(name, 64) + "\" is no name of a file: letters, digits and _ . - / alone");
  size_t begin = 0;
  while (begin <= name.size()) {
    const size_t end = std::min(name.find('/', begin), name.size());
    const std::string_view part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..")
      return fail("\"" + std::string(name) + "\" is no path within the script's folder");
    begin = end + 1;
  }
  return std::string(name) + (name.ends_with(".lua") ? "" : ".lua");
}

Result<std::string> read_file_of(const ScriptState& state, std::string_view name) {
  if (state.folder.empty()) return fail("script " + state.options.name + " has no folder");
  const std::string path = TRY(checked_path(name));
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(state.folder / path, error);
  if (error) return fail("there is no file " + path);
  const auto [folder_end, ignored] =
      std::mismatch(state.folder.begin(), state.folder.end(), real.begin(), real.end());
  if (folder_end != state.folder.end()) return fail("file " + path + " lies outside the script's folder");
  if (const Result<void> file = check_is_file(real.string()); !file)
    return fail("file " + path + " " + file.error().message);
  Result<std::string> text = read_bytes_of(real.string(), script_file_bytes_max);
  if (!text) return fail("file " + path + " " + text.error().message);
  if (text->size() > script_file_bytes_max)
    return fail("file " + path + " is longer than " + std::to_string(script_file_bytes_max) + " bytes");
  return text;
}

/// The key of a module: its path without ".lua", so that each is run once.
std::string_view module_key(const char* text, size_t bytes) noexcept {
  std::string_view name(text, bytes);
  if (name.ends_with(".lua")) name.remove_suffix(4);
  return name;
}

/// Runs a module and leaves its value; its key lies at 2, the table of modules at 3.
int run_module(lua_State* lua, ScriptState& state, const char* name, size_t bytes) {
  charge(lua, 100);
  if (!read_script_file(state, {name, bytes})) {
    lua_pushlstring(lua, state.text.data(), state.text.size());
    raise_here(lua);
  }
  lua_pushvalue(lua, 2);
  lua_pushboolean(lua, 0);
  lua_rawset(lua, 3);  // while it runs
  lua_pushfstring(lua, "@%s.lua", lua_tostring(lua, 2));
  if (load_in_pieces(lua, state.text, lua_tostring(lua, -1)) != LUA_OK) return lua_error(lua);
  lua_pushvalue(lua, 2);
  lua_call(lua, 1, 1);
  if (lua_isnil(lua, -1)) {
    lua_pop(lua, 1);
    lua_pushboolean(lua, 1);
  }
  lua_pushvalue(lua, 2);
  lua_pushvalue(lua, -2);
  lua_rawset(lua, 3);
  return 1;
}

int base_require(lua_State* lua) {
  size_t bytes = 0;
  const char* name = luaL_checklstring(lua, 1, &bytes);
  lua_settop(lua, 1);
  const std::string_view key = module_key(name, bytes);
  lua_pushlstring(lua, key.data(), key.size());
  lua_rawgetp(lua, LUA_REGISTRYINDEX, &registry_modules);
  lua_pushvalue(lua, 2);
  const int type = lua_rawget(lua, 3);
  if (type == LUA_TBOOLEAN && lua_toboolean(lua, -1) == 0)
    return luaL_error(lua, "require: module %s requires itself, or failed before", lua_tostring(lua, 2));
  if (type != LUA_TNIL) return 1;
  return run_module(lua, state_of(lua), name, bytes);
}

}  // namespace

bool read_script_file(ScriptState& state, std::string_view name) noexcept {
  Result<std::string> text = read_file_of(state, name);
  state.text = text ? *std::move(text) : std::move(text).error().message;
  return text.has_value();
}

void open_require(lua_State* lua) {
  lua_pushcfunction(lua, base_require);
  lua_setglobal(lua, "require");
}

}  // namespace scree
