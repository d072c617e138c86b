// A machine with Lua's own library, to compare with.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string>

namespace scree {

class StockLua {
 public:
  StockLua() : lua_(luaL_newstate(), lua_close) { luaL_openlibs(lua_.get()); }

  /// The text that a chunk returns; "error: " and the message where it raises one.
  std::string ask(const std::string& text) {
    lua_settop(lua_.get(), 0);
    const bool ended = luaL_loadbuffer(lua_.get(), text.data(), text.size(), "@test") == LUA_OK &&
                       lua_pcall(lua_.get(), 0, 1, 0) == LUA_OK;
    size_t bytes = 0;
    const char* result = lua_tolstring(lua_.get(), -1, &bytes);
    return (ended ? "" : "error: ") + std::string(result == nullptr ? "" : result, bytes);
  }

 private:
  std::unique_ptr<lua_State, decltype(&lua_close)> lua_;
};

}  // namespace scree
