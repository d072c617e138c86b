// Lua's math, with random numbers that the host seeds: xoshiro256** (Blackman and Vigna 2018), as in Lua.
#include <bit>

#include "server/rules/sandbox/library.h"
#include "server/rules/sandbox/script_state.h"

namespace scree {
namespace {

uint64_t next_random(ScriptState& state) {
  auto& s = state.random;
  const uint64_t value = std::rotl(s[1] * 5, 7) * 9;
  const uint64_t shifted = s[1] << 17U;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= shifted;
  s[3] = std::rotl(s[3], 45);
  return value;
}

/// Uniform in 0 to `most`: draws below the next power of two until one fits.
uint64_t random_up_to(ScriptState& state, uint64_t most) {
  const uint64_t mask = most == 0 ? 0 : ~uint64_t{0} >> static_cast<unsigned>(std::countl_zero(most));
  for (;;)
    if (const uint64_t value = next_random(state) & mask; value <= most) return value;
}

int math_random(lua_State* lua) {
  ScriptState& state = state_of(lua);
  lua_Integer low = 1;
  lua_Integer high = 0;
  switch (lua_gettop(lua)) {
    case 0:
      lua_pushnumber(lua, static_cast<lua_Number>(next_random(state) >> 11U) * 0x1p-53);
      return 1;
    case 1:
      high = luaL_checkinteger(lua, 1);
      if (high == 0) {
        lua_pushinteger(lua, static_cast<lua_Integer>(next_random(state)));
        return 1;
      }
      break;
    case 2:
      low = luaL_checkinteger(lua, 1);
      high = luaL_checkinteger(lua, 2);
      break;
    default:
      return luaL_error(lua, "wrong number of arguments");
  }
  luaL_argcheck(lua, low <= high, 1, "interval is empty");
  const uint64_t most = static_cast<uint64_t>(high) - static_cast<uint64_t>(low);
  lua_pushinteger(lua, static_cast<lua_Integer>(static_cast<uint64_t>(low) + random_up_to(state, most)));
  return 1;
}

}  // namespace

void seed_random(ScriptState& state, uint64_t seed) noexcept {
  state.random = {seed, 0xff, 0, 0};
  for (int i = 0; i < 16; ++i) next_random(state);
}

void open_math(lua_State* lua) {
  static constexpr luaL_Reg functions[] = {{"random", math_random}, {nullptr, nullptr}};
  static constexpr const char* constants[] = {"pi", "huge", "maxinteger", "mininteger"};
  static constexpr const char* adopted[] = {
      "abs", "acos", "asin", "atan", "ceil", "cos",  "deg", "exp",       "floor", "fmod", "log",
      "max", "min",  "modf", "rad",  "sin",  "sqrt", "tan", "tointeger", "type",  "ult",  nullptr};
  push_library(lua, "math");
  set_functions(lua, functions);
  lua_pushcfunction(lua, luaopen_math);
  lua_call(lua, 0, 1);
  for (const char* name : constants) {
    lua_getfield(lua, -1, name);
    lua_setfield(lua, -3, name);
  }
  adopt(lua, adopted);
  lua_settop(lua, 0);
}

}  // namespace scree
