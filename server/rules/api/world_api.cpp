// The world as a whole: time, settings, materials.
#include <charconv>

#include "server/rules/api/asking.h"
#include "server/rules/api/parts.h"
#include "server/world/settings.h"

namespace scree {

namespace {

Result<void> tick(RulesCall& call) {
  call.results().integer(static_cast<int64_t>(world_of(call).tick()));
  return {};
}

Result<void> time(RulesCall& call) {
  const World& world = world_of(call);
  call.results().number(static_cast<double>(world.tick()) / world.config().tick_rate_hz);
  return {};
}

Result<void> rate(RulesCall& call) {
  call.results().integer(world_of(call).config().tick_rate_hz);
  return {};
}

Result<void> voxel(RulesCall& call) {
  call.results().number(world_of(call).config().terrain.voxel_size_m);
  return {};
}

Result<void> materials(RulesCall& call) {
  call.results().open_table();
  for (const std::string_view name : world_of(call).config().palette->names()) call.results().text(name);
  call.results().close_table();
  return {};
}

/// Lua's names have no dash.
std::string name_of_setting(std::string_view text) {
  std::string name(text);
  if (!is_material_setting(name)) std::ranges::replace(name, '_', '-');
  return name;
}

void write_setting(ScriptWriter& to, const SettingValue& value) {
  double number = 0.0;
  const char* const last = value.value.data() + value.value.size();
  const auto [end, error] = std::from_chars(value.value.data(), last, number);
  if (value.value == "true" || value.value == "false")
    to.boolean(value.value == "true");
  else if (error == std::errc() && end == last)
    to.number(number);
  else
    to.text(value.value);
}

Result<void> setting(RulesCall& call) {
  const ScriptValue wanted = call.argument(1, "name");
  const std::string name = name_of_setting(TRY(wanted.text()));
  const SettingValues all = print(world_of(call).config());
  call.call.charge(work_of_request);
  const auto found = std::ranges::find(all, name, &SettingValue::name);
  if (found == all.end()) return wanted.refuse("there is no setting '" + name + "'");
  write_setting(call.results(), *found);
  return {};
}

Result<std::string> text_of_setting(const ScriptValue& value) {
  if (value.is_boolean()) return std::string(TRY(value.boolean()) ? "true" : "false");
  if (value.is_text()) return std::string(TRY(value.text()));
  std::array<char, 32> digits{};
  const double number = TRY(value.number());
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return std::string(digits.data(), end);
}

Result<void> set_settings(RulesCall& call) {
  const ScriptValue table = call.argument(1, "settings");
  SettingsRequest request;
  TRY(table.each([&](const ScriptValue& key, const ScriptValue& value) -> Result<void> {
    request.settings.push_back({name_of_setting(TRY(key.text())), TRY(text_of_setting(value))});
    return {};
  }));
  std::ranges::sort(request.settings, {}, &SettingValue::name);  // a table has no certain order
  WorldConfig changed = world_of(call).config();
  if (const Result<void> valid = set_all(changed, request.settings); !valid)
    return table.refuse(valid.error().message);
  return ask_world(call, std::move(request));
}

constexpr ApiFunction time_rows[] = {
    {"world", "tick", "", "integer", "The tick that the world stands at; it begins with 0.",
     "assert(world.tick() >= 0)", tick},
    {"world", "time", "", "number", "Seconds of the world since it began: ticks, not hours of the machine.",
     "log(\"the world is \" .. world.time() .. \" s old\")", time},
    {"world", "rate", "", "integer", "Ticks in a second.", "assert(world.rate() > 0)", rate},
    {"world", "voxel", "", "number", "Size of a voxel, metres: what is smaller than two is no edit.",
     "assert(world.voxel() > 0)", voxel},
    {"world", "materials", "", "string[]", "The names of all materials.",
     "for _, name in ipairs(world.materials()) do log(name) end", materials},
    {"world", "setting", "name: string", "boolean | number | string",
     "How a setting of the server stands (docs/host.md lists them). Names may have _ in place of -.",
     "log(\"at most \" .. world.setting(\"pieces_max\") .. \" pieces\")", setting},
    {"world", "set", "settings: table<string, boolean | number | string>", "",
     "Changes settings: all of them, or none. Numbers of materials are settings, too.",
     "world.set{ islands = true, air_drag = 5 }", set_settings},
};

}  // namespace

std::span<const ApiFunction> time_api() {
  return time_rows;
}

std::span<const ApiFunction> world_api() {
  static const std::vector<ApiFunction> all = [] {
    std::vector<ApiFunction> rows;
    for (const std::span<const ApiFunction> part : {time_api(), edit_api(), query_api()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

}  // namespace scree
