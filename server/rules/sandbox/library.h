// What a script finds, and how it differs from stock Lua 5.4. Every function takes work off in proportion to
// what it touches.
//
// As in Lua: assert, error, getmetatable, ipairs, next, pairs, pcall, rawequal, rawget, rawlen, rawset,
// select, setmetatable, tonumber, tostring, type, _G, _VERSION; all of math, string, table, utf8 and
// coroutine but for:
//   absent           io, os, debug, package, dofile, loadfile, warn, math.randomseed, string.dump,
//                    coroutine.close: they reach the machine, or run code that no hook watches
//   require(name)    a file of the script's folder: letters, digits and _ . - /, ".lua" may be left out. Once
//   load(text)       text only, never bytecode
//   print            goes to ScriptOptions::print, with spaces between the values
//   collectgarbage   "count" only
//   xpcall           the handler is called after the error has left the function, so it sees no traceback
//   setmetatable     refuses __gc and weak keys (__mode = "k"); "v" and "kv" are as in Lua
//   tostring         gives "table" or "function", without an address; string.format has no %p
//   math.random      xoshiro256**, as in Lua, from the host's seed
//   table.sort       is stable; a wrong order function gives a wrong order and no error
//   patterns         run in time linear in the text; no %b, %f and back references %1
// The tables of the library and those that the host binds are read-only. rawset() can hide their entries,
// from the script itself alone: each script has a machine of its own.
#pragma once

#include <lua.hpp>

namespace scree {

/// Copies functions of Lua's own library from the table on top of the stack, each with a charge for its
/// texts, into the table below it; pops the upper. A name that is absent is a programmer's error. Raises.
void adopt(lua_State* lua, const char* const* names);

/// Sets C functions, ended by a null name, in the table on top of the stack. Raises.
void set_functions(lua_State* lua, const luaL_Reg* functions);

}  // namespace scree
