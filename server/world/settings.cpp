#include "server/world/settings.h"

#include <algorithm>
#include <array>

#include "shared/base/limits.h"

namespace scree {

namespace {

Result<void> parse_value(std::string_view value, bool& to) {
  if (value != "true" && value != "false") return fail("is true or false");
  to = value == "true";
  return {};
}

std::string print_value(bool value) {
  return value ? "true" : "false";
}

/// A choice among named values; `names` in the order of the enum's, which count from 0.
template <typename Enum, size_t Count>
Result<void> parse_choice(std::string_view value, Enum& to,
                          const std::array<std::string_view, Count>& names) {
  const auto found = std::ranges::find(names, value);
  if (found != names.end()) {
    to = static_cast<Enum>(found - names.begin());
    return {};
  }
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "is one of " : ", ") + std::string(name);
  return fail(all);
}

constexpr std::array<std::string_view, 3> collider_names{"field", "mesh", "rays"};

Result<void> parse_value(std::string_view value, TerrainColliderKind& to) {
  return parse_choice(value, to, collider_names);
}

std::string print_value(TerrainColliderKind value) {
  return std::string(collider_names[static_cast<size_t>(value)]);
}

/// A row of the table: any member whose type has a parse_value and a print_value.
template <auto Member>
constexpr Setting setting(std::string_view name, std::string_view help) {
  return {name, help, [](std::string_view value, Methods& to) { return parse_value(value, to.*Member); },
          [](const Methods& from) { return print_value(from.*Member); }};
}

constexpr std::array table{
    setting<&Methods::collider>("collider",
                                "how pieces find the terrain that they touch: field, mesh or rays"),
    setting<&Methods::impacts>("impacts", "whether pieces that strike hard break again: true or false"),
    setting<&Methods::dents>("dents", "whether pieces that strike hard dent soft ground: true or false"),
    setting<&Methods::islands>("islands",
                               "whether terrain that is cut off from the ground falls: true or false"),
};

/// Bound one by one, so that a member that is new and not in the table does not compile.
constexpr size_t members() {
  const auto [collider, impacts, dents, islands] = Methods{};
  return std::array{static_cast<int>(collider), static_cast<int>(impacts), static_cast<int>(dents),
                    static_cast<int>(islands)}
      .size();
}
static_assert(members() == table.size());

}  // namespace

std::span<const Setting> settings() {
  return table;
}

Result<void> set(Methods& methods, const SettingValue& setting) {
  const auto row = std::ranges::find(table, setting.name, &Setting::name);
  if (row == table.end()) {
    std::string names;
    for (const Setting& known : table) names += (names.empty() ? "" : ", ") + std::string(known.name);
    return fail("there is no setting '" + setting.name + "'; there are " + names);
  }
  const Result<void> parsed = row->parse(setting.value, methods);
  if (!parsed) return fail(setting.name + " " + parsed.error().message + ", not '" + setting.value + "'");
  return {};
}

Result<void> set_all(Methods& methods, const SettingValues& values) {
  if (values.size() > limits::settings_max)
    return fail("more than " + std::to_string(limits::settings_max) +
                " settings at once (limits.settings_max)");
  Methods changed = methods;
  for (auto value = values.begin(); value != values.end(); ++value) {
    if (std::ranges::find(values.begin(), value, value->name, &SettingValue::name) != value)
      return fail(value->name + " is set twice");
    if (Result<void> done = set(changed, *value); !done) return done;
  }
  methods = changed;
  return {};
}

SettingValues print(const Methods& methods) {
  SettingValues values;
  for (const Setting& setting : table) values.push_back({std::string(setting.name), setting.print(methods)});
  return values;
}

}  // namespace scree
