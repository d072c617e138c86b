#include "server/rules/sandbox/json_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "server/rules/sandbox/script_limits.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {
namespace {

using Json = nlohmann::json;

std::string hex_text(std::string_view bytes) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const char byte : bytes) {
    text += digits[static_cast<unsigned char>(byte) >> 4U];
    text += digits[static_cast<unsigned char>(byte) & 15U];
  }
  return text;
}

std::optional<std::string> bytes_of_hex(std::string_view hex) {
  std::string bytes;
  if (hex.size() % 2 != 0) return std::nullopt;
  for (size_t i = 0; i < hex.size(); i += 2) {
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
    if (error != std::errc{} || end != hex.data() + i + 2) return std::nullopt;
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

/// A key, in the order of the text: integers, other numbers, texts, booleans.
using Key = std::variant<int64_t, double, std::string, bool>;

class JsonWriter {
 public:
  explicit JsonWriter(size_t bytes_max) : bytes_max_(bytes_max) {}

  Result<void> write(const ScriptValue& value) {
    if (text_.size() > bytes_max_)
      return fail("a value is longer than " + std::to_string(bytes_max_) + " bytes as JSON");
    if (value.is_nil()) return add("null");
    if (value.is_boolean()) return add(*value.boolean() ? "true" : "false");
    if (value.is_integer()) return add(std::to_string(*value.integer()));
    if (value.is_number()) return write_number(lua_tonumber(value.lua(), value.index()));
    if (value.is_text()) return write_text(*value.text());
    if (value.is_table()) return write_table(value);
    return value.refuse(value.type_text() + " cannot be kept");
  }

  Result<std::string> finish() {
    if (text_.size() > bytes_max_)
      return fail("a value is longer than " + std::to_string(bytes_max_) + " bytes as JSON");
    return std::move(text_);
  }

 private:
  Result<void> add(std::string_view text) {
    text_ += text;
    return {};
  }

  Result<void> write_number(double value) {
    if (std::isnan(value)) return add(R"({"$float":"nan"})");
    if (std::isinf(value)) return add(value > 0 ? R"({"$float":"inf"})" : R"({"$float":"-inf"})");
    char digits[32];
    std::string_view text(
        digits, static_cast<size_t>(std::to_chars(digits, digits + sizeof digits, value).ptr - digits));
    text_ += text;
    if (text.find_first_of(".e") == std::string_view::npos) text_ += ".0";
    return {};
  }

  Result<void> write_text(std::string_view text) {
    if (text.size() > bytes_max_)
      return fail("a value is longer than " + std::to_string(bytes_max_) + " bytes as JSON");
    if (!is_utf8(text)) return add("{\"$bytes\":\"" + hex_text(text) + "\"}");
    return add(Json(text).dump());
  }

  Result<void> write_table(const ScriptValue& table) {
    const void* address = lua_topointer(table.lua(), table.index());
    if (std::ranges::find(within_, address) != within_.end()) return table.refuse("the table lies in itself");
    if (within_.size() == static_cast<size_t>(script_json_depth_max))
      return table.refuse("tables lie in tables more than " + std::to_string(script_json_depth_max) +
                          " deep");
    within_.push_back(address);
    TRY(write_entries(table));
    within_.pop_back();
    return {};
  }

  Result<void> write_entries(const ScriptValue& table) {
    std::vector<Key> keys;
    bool names = true;
    TRY(table.each([&](const ScriptValue& key, const ScriptValue&) -> Result<void> {
      if (keys.size() * 2 > bytes_max_)
        return fail("a value is longer than " + std::to_string(bytes_max_) + " bytes as JSON");
      if (key.is_integer())
        keys.emplace_back(*key.integer());
      else if (key.is_number())
        keys.emplace_back(lua_tonumber(key.lua(), key.index()));
      else if (key.is_text())
        keys.emplace_back(std::string(*key.text()));
      else if (key.is_boolean())
        keys.emplace_back(*key.boolean());
      else
        return key.refuse(key.type_text() + " cannot be kept");
      const auto* name = std::get_if<std::string>(&keys.back());
      names = names && name != nullptr && is_utf8(*name) && !name->starts_with('$');
      return {};
    }));
    std::ranges::sort(keys);
    const bool array = keys.empty() || (keys.front() == Key(int64_t{1}) &&
                                        keys.back() == Key(static_cast<int64_t>(keys.size())));
    text_ += array ? "[" : names ? "{" : R"({"$pairs":[)";
    for (size_t i = 0; i < keys.size(); ++i) {
      if (i > 0) text_ += ',';
      TRY(write_entry(table, keys[i], array, names));
    }
    text_ += array ? "]" : names ? "}" : "]}";
    return {};
  }

  Result<void> write_entry(const ScriptValue& table, const Key& key, bool array, bool names) {
    lua_State* lua = table.lua();
    const int top = lua_gettop(lua);
    push_key(lua, key);
    const ScriptValue written(lua, -1, "a key of " + table.name());
    lua_pushvalue(lua, -1);
    lua_rawget(lua, table.index());
    const auto* name = std::get_if<std::string>(&key);
    const ScriptValue value(lua, -1, table.name() + (name != nullptr ? "." + showable(*name, 64) : "[…]"));
    if (!array && !names) text_ += '[';
    if (!array) TRY(write(written));
    if (!array) text_ += names ? ':' : ',';
    TRY(write(value));
    if (!array && !names) text_ += ']';
    lua_settop(lua, top);
    return {};
  }

  static void push_key(lua_State* lua, const Key& key) {
    CHECK(lua_checkstack(lua, 8) != 0);
    if (const auto* integer = std::get_if<int64_t>(&key)) lua_pushinteger(lua, *integer);
    if (const auto* number = std::get_if<double>(&key)) lua_pushnumber(lua, *number);
    if (const auto* text = std::get_if<std::string>(&key)) lua_pushlstring(lua, text->data(), text->size());
    if (const auto* boolean = std::get_if<bool>(&key)) lua_pushboolean(lua, *boolean ? 1 : 0);
  }

  size_t bytes_max_;
  std::string text_;
  std::vector<const void*> within_;
};

/// Nesting of brackets outside of texts: read before the text is parsed.
int nesting_of(std::string_view text) {
  int depth = 0;
  int most = 0;
  bool in_text = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') most = std::max(most, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return most;
}

/// Pushes values; what lies on the stack after an error is the caller's to take off.
class JsonPusher {
 public:
  explicit JsonPusher(lua_State* lua) : lua_(lua) {}

  Result<void> push(const Json& json) {
    CHECK(lua_checkstack(lua_, 8) != 0);
    switch (json.type()) {
      case Json::value_t::null:
        lua_pushnil(lua_);
        return {};
      case Json::value_t::boolean:
        lua_pushboolean(lua_, json.get<bool>() ? 1 : 0);
        return {};
      case Json::value_t::number_integer:
        lua_pushinteger(lua_, json.get<int64_t>());
        return {};
      case Json::value_t::number_unsigned:
        return push_unsigned(json.get<uint64_t>());
      case Json::value_t::number_float:
        lua_pushnumber(lua_, json.get<double>());
        return {};
      case Json::value_t::string:
        push_text(json.get_ref<const std::string&>());
        return {};
      case Json::value_t::array:
        return push_array(json);
      case Json::value_t::object:
        return push_object(json);
      default:
        return fail("a kept value is no JSON");
    }
  }

 private:
  void push_text(const std::string& text) { lua_pushlstring(lua_, text.data(), text.size()); }

  Result<void> push_unsigned(uint64_t value) {
    if (value <= static_cast<uint64_t>(INT64_MAX))
      lua_pushinteger(lua_, static_cast<int64_t>(value));
    else
      lua_pushnumber(lua_, static_cast<double>(value));
    return {};
  }

  Result<void> push_array(const Json& json) {
    lua_newtable(lua_);
    int64_t next = 1;
    for (const Json& item : json) {
      TRY(push(item));
      lua_rawseti(lua_, -2, next++);
    }
    return {};
  }

  Result<void> push_object(const Json& json) {
    if (json.size() == 1 && json.begin().key().starts_with('$'))
      return push_special(json.begin().key(), *json.begin());
    lua_newtable(lua_);
    for (const auto& [key, value] : json.items()) {
      push_text(key);
      TRY(push(value));
      lua_rawset(lua_, -3);
    }
    return {};
  }

  Result<void> push_special(const std::string& key, const Json& value) {
    if (key == "$pairs") return push_pairs(value);
    if (!value.is_string()) return fail(key + " is no text");
    const auto& text = value.get_ref<const std::string&>();
    if (key == "$bytes") {
      const std::optional<std::string> bytes = bytes_of_hex(text);
      if (!bytes) return fail("$bytes is no hexadecimal text");
      push_text(*bytes);
      return {};
    }
    if (key != "$float" || (text != "inf" && text != "-inf" && text != "nan"))
      return fail("\"" + showable(key, 64) + "\": \"" + showable(text, 64) + "\" is no kept value");
    const double infinite = text == "-inf" ? -HUGE_VAL : HUGE_VAL;
    lua_pushnumber(lua_, text == "nan" ? std::nan("") : infinite);
    return {};
  }

  Result<void> push_pairs(const Json& pairs) {
    if (!pairs.is_array()) return fail("$pairs is no list");
    lua_newtable(lua_);
    for (const Json& pair : pairs) {
      if (!pair.is_array() || pair.size() != 2) return fail("an item of $pairs is no pair");
      TRY(push(pair[0]));
      const bool number = lua_type(lua_, -1) == LUA_TNUMBER;
      if (lua_isnil(lua_, -1) || lua_istable(lua_, -1) || (number && std::isnan(lua_tonumber(lua_, -1))))
        return fail("a key of $pairs is no key");
      TRY(push(pair[1]));
      lua_rawset(lua_, -3);
    }
    return {};
  }

  lua_State* lua_;
};

/// A table is at most three brackets: {"$pairs":[[…]]}.
constexpr int brackets_max = 3 * script_json_depth_max + 1;

}  // namespace

Result<std::string> to_json_text(const ScriptValue& value, size_t bytes_max) {
  const int top = lua_gettop(value.lua());
  JsonWriter writer(bytes_max);
  const Result<void> written = writer.write(value);
  lua_settop(value.lua(), top);
  TRY(written);
  return writer.finish();
}

Result<void> write_json(ScriptWriter& to, std::string_view text) {
  if (nesting_of(text) > brackets_max)
    return fail("tables lie in tables more than " + std::to_string(script_json_depth_max) + " deep");
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return fail("a kept value is no JSON");
  const int top = lua_gettop(to.lua());
  const Result<void> pushed = JsonPusher(to.lua()).push(json);
  if (!pushed) lua_settop(to.lua(), top);
  TRY(pushed);
  to.pushed();
  return {};
}

}  // namespace scree
