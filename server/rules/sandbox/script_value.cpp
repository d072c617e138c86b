#include "server/rules/sandbox/script_value.h"

#include <cmath>

#include "server/rules/sandbox/handles.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// For values that are pushed next.
void make_room(lua_State* lua) {
  CHECK(lua_checkstack(lua, 8) != 0, "a call has a million values on the stack");
}

std::string article(const std::string& type) {
  return type == "nil" ? type : "a " + type;
}

}  // namespace

ScriptValue::ScriptValue(lua_State* lua, int index, std::string name)
    : lua_(lua), index_(lua_absindex(lua, index)), name_(std::move(name)) {}

bool ScriptValue::is_nil() const {
  return lua_isnoneornil(lua_, index_);
}
bool ScriptValue::is_boolean() const {
  return lua_isboolean(lua_, index_);
}
bool ScriptValue::is_integer() const {
  return lua_isinteger(lua_, index_) != 0;
}
bool ScriptValue::is_number() const {
  return lua_type(lua_, index_) == LUA_TNUMBER;
}
bool ScriptValue::is_text() const {
  return lua_type(lua_, index_) == LUA_TSTRING;
}
bool ScriptValue::is_table() const {
  return lua_istable(lua_, index_);
}
bool ScriptValue::is_function() const {
  return lua_isfunction(lua_, index_);
}

std::string ScriptValue::type_text() const {
  if (is_nil()) return "nil";
  if (is_text()) return "a string";
  if (const auto handle = handle_at(lua_, index_)) return article(std::string(handle->type));
  return article(luaL_typename(lua_, index_));
}

tl::unexpected<Error> ScriptValue::refuse(std::string_view reason) const {
  return fail(name_ + ": " + std::string(reason));
}

Result<bool> ScriptValue::boolean() const {
  if (!is_boolean()) return fail(name_ + " is " + type_text() + ", not a boolean");
  return lua_toboolean(lua_, index_) != 0;
}

Result<int64_t> ScriptValue::integer() const {
  int is_integer = 0;
  const lua_Integer value = is_number() ? lua_tointegerx(lua_, index_, &is_integer) : 0;
  if (is_integer != 0) return value;
  if (is_number()) return fail(name_ + " is a number with a fraction, not an integer");
  return fail(name_ + " is " + type_text() + ", not an integer");
}

Result<double> ScriptValue::number() const {
  if (!is_number()) return fail(name_ + " is " + type_text() + ", not a number");
  const double value = lua_tonumber(lua_, index_);
  if (!std::isfinite(value)) return fail(name_ + " is no finite number");
  return value;
}

Result<std::string_view> ScriptValue::text() const {
  if (!is_text()) return fail(name_ + " is " + type_text() + ", not a string");
  size_t bytes = 0;
  const char* text = lua_tolstring(lua_, index_, &bytes);
  return std::string_view(text, bytes);
}

Result<ScriptFunction> ScriptValue::function() const {
  if (!is_function()) return fail(name_ + " is " + type_text() + ", not a function");
  make_room(lua_);
  lua_pushvalue(lua_, index_);
  const int slot = luaL_ref(lua_, LUA_REGISTRYINDEX);
  ScriptFunction kept;
  kept.slot_ =
      std::shared_ptr<const int>(new int(slot), [released = state_of(lua_).released](const int* gone) {
        const std::lock_guard lock(released->mutex);
        released->slots.push_back(*gone);
        delete gone;
      });
  return kept;
}

Result<uint64_t> ScriptValue::handle(std::string_view type) const {
  const auto found = handle_at(lua_, index_);
  if (!found || found->type != type)
    return fail(name_ + " is " + type_text() + ", not " + article(std::string(type)));
  return found->number;
}

Result<ScriptValue> ScriptValue::field(std::string_view key) const {
  if (!is_table()) return fail(name_ + " is " + type_text() + ", not a table");
  make_room(lua_);
  lua_pushlstring(lua_, key.data(), key.size());
  lua_rawget(lua_, index_);
  return ScriptValue(lua_, -1, name_ + "." + std::string(key));
}

Result<ScriptValue> ScriptValue::item(int64_t index) const {
  if (!is_table()) return fail(name_ + " is " + type_text() + ", not a table");
  make_room(lua_);
  lua_rawgeti(lua_, index_, index);
  return ScriptValue(lua_, -1, name_ + "[" + std::to_string(index) + "]");
}

Result<int64_t> ScriptValue::length() const {
  if (!is_table()) return fail(name_ + " is " + type_text() + ", not a table");
  return static_cast<int64_t>(lua_rawlen(lua_, index_));
}

Result<void> ScriptValue::each(
    const std::function<Result<void>(const ScriptValue& key, const ScriptValue& value)>& to) const {
  if (!is_table()) return fail(name_ + " is " + type_text() + ", not a table");
  make_room(lua_);
  const int top = lua_gettop(lua_);
  lua_pushnil(lua_);
  while (lua_next(lua_, index_) != 0) {
    const ScriptValue key(lua_, top + 1, "a key of " + name_);
    std::string name = name_ + "[…]";
    if (key.is_text()) name = name_ + "." + std::string(*key.text());
    if (key.is_integer()) name = name_ + "[" + std::to_string(*key.integer()) + "]";
    const Result<void> done = to(key, ScriptValue(lua_, top + 2, std::move(name)));
    lua_settop(lua_, top + 1);
    if (!done) lua_settop(lua_, top);
    TRY(done);
  }
  return {};
}

ReadScope::ReadScope(const ScriptValue& of) : lua_(of.lua()), top_(lua_gettop(of.lua())) {}

ReadScope::~ReadScope() {
  lua_settop(lua_, top_);
}

ScriptWriter::ScriptWriter(lua_State* lua) : lua_(lua) {}

/// A value lies on the stack: it is put into the open table, or counts.
void ScriptWriter::pushed() {
  if (levels_.empty()) {
    ++count_;
    return;
  }
  Level& level = levels_.back();
  if (level.keyed)
    lua_rawset(lua_, -3);
  else
    lua_rawseti(lua_, -2, level.next++);
  level.keyed = false;
}

void ScriptWriter::nil() {
  make_room(lua_);
  lua_pushnil(lua_);
  pushed();
}

void ScriptWriter::boolean(bool value) {
  make_room(lua_);
  lua_pushboolean(lua_, value ? 1 : 0);
  pushed();
}

void ScriptWriter::integer(int64_t value) {
  make_room(lua_);
  lua_pushinteger(lua_, value);
  pushed();
}

void ScriptWriter::number(double value) {
  make_room(lua_);
  lua_pushnumber(lua_, value);
  pushed();
}

void ScriptWriter::text(std::string_view value) {
  make_room(lua_);
  lua_pushlstring(lua_, value.data(), value.size());
  pushed();
}

void ScriptWriter::function(const ScriptFunction& value) {
  CHECK(value, "an empty ScriptFunction is not written");
  make_room(lua_);
  lua_rawgeti(lua_, LUA_REGISTRYINDEX, *value.slot_);
  pushed();
}

void ScriptWriter::handle(const ScriptHandle& value) {
  make_room(lua_);
  push_handle(lua_, value);
  pushed();
}

void ScriptWriter::vector(double x, double y, double z) {
  make_room(lua_);
  lua_createtable(lua_, 0, 3);
  const auto set = [&](const char* key, double value) {
    lua_pushstring(lua_, key);
    lua_pushnumber(lua_, value);
    lua_rawset(lua_, -3);
  };
  set("x", x);
  set("y", y);
  set("z", z);
  if (lua_rawgetp(lua_, LUA_REGISTRYINDEX, &registry_vectors) == LUA_TTABLE)
    lua_setmetatable(lua_, -2);
  else
    lua_pop(lua_, 1);
  pushed();
}

void ScriptWriter::open_table() {
  make_room(lua_);
  lua_newtable(lua_);
  levels_.emplace_back();
}

void ScriptWriter::close_table() {
  CHECK(!levels_.empty(), "close_table() without open_table()");
  CHECK(!levels_.back().keyed, "a key of a table has got its value");
  levels_.pop_back();
  pushed();
}

void ScriptWriter::name(std::string_view key) {
  CHECK(!levels_.empty() && !levels_.back().keyed, "a name belongs to a value in a table");
  make_room(lua_);
  lua_pushlstring(lua_, key.data(), key.size());
  levels_.back().keyed = true;
}

void ScriptWriter::key(int64_t key) {
  CHECK(!levels_.empty() && !levels_.back().keyed, "a key belongs to a value in a table");
  make_room(lua_);
  lua_pushinteger(lua_, key);
  levels_.back().keyed = true;
}

void ScriptWriter::value(const ScriptValue& value) {
  CHECK(&state_of(value.lua()) == &state_of(lua_), "a value is written to the script that gave it");
  make_room(lua_);
  make_room(value.lua());
  lua_pushvalue(value.lua(), value.index());
  if (value.lua() != lua_) lua_xmove(value.lua(), lua_, 1);
  pushed();
}

}  // namespace scree
