// What rules keep with the world.
#include <map>
#include <string_view>

#include "server/formats/world_value.h"
#include "server/rules/api.h"
#include "server/rules/mod.h"
#include "server/rules/sandbox/json_values.h"

namespace scree {

namespace {

/// Keys of a mod begin with its name, so that mods do not change each other's.
std::string whole_key(const RulesCall& call, std::string_view key) {
  return call.mod.name() + "/" + std::string(key);
}

/// The value as text, with what was written in this tick.
std::optional<std::string> value_of(const RulesCall& call, const std::string& key) {
  if (const auto written = call.mod.written(key)) return *written;
  for (const KeptValue& one : *call.moment.world->game().kept)
    if (one.key == key) return one.value;
  return std::nullopt;
}

Result<void> get(RulesCall& call) {
  const std::string key = whole_key(call, TRY(call.argument(1, "key").text()));
  if (const std::optional<std::string> text = value_of(call, key)) return write_json(call.results(), *text);
  const ScriptValue otherwise = call.argument(2, "otherwise");
  if (otherwise.is_nil())
    call.results().nil();
  else
    call.results().value(otherwise);
  return {};
}

/// All that rules keep with a world, of all mods, with what this one wrote in the tick: it has bounds.
Result<void> check_room(const RulesCall& call, const std::string& key, const std::string& text) {
  std::map<std::string_view, size_t> sizes;
  for (const KeptValue& one : *call.moment.world->game().kept) sizes[one.key] = one.value.size();
  for (const auto& [written, value] : call.mod.all_written())
    if (value)
      sizes[written] = value->size();
    else
      sizes.erase(written);
  sizes[key] = text.size();
  size_t bytes = 0;
  for (const auto& [name, size] : sizes) bytes += name.size() + size;
  if (bytes > limits::kept_bytes_max)
    return fail("all rules together keep " + std::to_string(limits::kept_bytes_max) +
                " bytes, and this would make " + std::to_string(bytes));
  if (sizes.size() <= limits::kept_values_max) return {};
  return fail("all rules together keep " + std::to_string(limits::kept_values_max) + " values at most");
}

Result<void> set(RulesCall& call) {
  const ScriptValue name = call.argument(1, "key");
  const std::string key = whole_key(call, TRY(name.text()));
  const ScriptValue value = call.argument(2, "value");
  if (const Result<void> valid = validate(KeptValue{key, {}}); !valid)
    return name.refuse(valid.error().message);
  if (value.is_nil()) {
    TRY(call.mod.ask(call.moment, RulesRequest{ForgetValue{key}}, 0));
    call.mod.note_written(key, std::nullopt);
    return {};
  }
  std::string text = TRY(to_json_text(value, limits::kept_value_bytes_max));
  TRY(check_room(call, key, text));
  TRY(call.mod.ask(call.moment, RulesRequest{KeepValue{{key, text}}}, 0));
  call.mod.note_written(key, std::move(text));
  return {};
}

Result<void> keys(RulesCall& call) {
  const ScriptValue prefix = call.argument(1, "prefix");
  const std::string begin = whole_key(call, prefix.is_nil() ? std::string_view() : TRY(prefix.text()));
  const size_t own = call.mod.name().size() + 1;
  std::map<std::string, bool> found;
  for (const KeptValue& one : *call.moment.world->game().kept)
    if (one.key.starts_with(begin)) found[one.key] = true;
  for (const auto& [key, value] : call.mod.all_written())
    if (key.starts_with(begin)) found[key] = value.has_value();
  call.results().open_table();
  for (const auto& [key, is_there] : found)
    if (is_there) call.results().text(std::string_view(key).substr(own));
  call.results().close_table();
  return {};
}

constexpr ApiFunction rows[] = {
    {"store", "get", "key: string, otherwise?: any", "any",
     "The value that was kept under a key, or `otherwise`. Each mod has keys of its own.",
     "local best = store.get(\"best\", 0)", get},
    {"store", "set", "key: string, value: any", "",
     "Keeps a value with the world: booleans, numbers, texts, and tables of these, 16 KiB each. It is saved "
     "together with the world, so both are of the same tick after a crash. nil forgets it. All rules "
     "together keep "
     "256 KiB and 1,024 values. A vec comes back as a plain table: vec(store.get(\"place\")).",
     "store.set(\"score\", { red = 3, blue = 1.5 })\nassert(store.get(\"score\").red == 3)", set},
    {"store", "keys", "prefix?: string", "string[]", "The keys that begin so, in order.",
     "store.set(\"plot 1\", \"anna\")\nassert(store.keys(\"plot\")[1] == \"plot 1\")", keys},
};

}  // namespace

std::span<const ApiFunction> store_api() {
  return rows;
}

}  // namespace scree
