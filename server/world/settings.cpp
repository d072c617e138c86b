#include "server/world/settings.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "shared/base/limits.h"
#include "shared/base/listed.h"

namespace scree {

namespace {

/// The names of a choice's values, in their order.
template <typename Choice>
constexpr std::array<std::string_view, 0> names_of{};
template <>
constexpr std::array<std::string_view, 2> names_of<bool>{"false", "true"};
template <>
constexpr std::array<std::string_view, 3> names_of<TerrainColliderKind>{"field", "mesh", "rays"};
template <>
constexpr std::array<std::string_view, 4> names_of<Recombination>{"stamp", "slices", "sphere", "off"};
template <>
constexpr std::array<std::string_view, 3> names_of<Cutter>{"field", "slice", "conform"};
template <>
constexpr std::array<std::string_view, 3> names_of<Simplifier>{"none", "hull", "merge"};

template <typename Choice>
Result<void> parse_choice(std::string_view value, Choice& to) {
  const auto& names = names_of<Choice>;
  const auto found = std::ranges::find(names, value);
  if (found == names.end()) return fail("is " + listed(names));
  to = static_cast<Choice>(found - names.begin());
  return {};
}

template <typename Choice>
std::string print_choice(Choice value) {
  return std::string(names_of<Choice>.at(static_cast<size_t>(value)));
}

/// A row of the table, for a member whose type has names_of.
template <auto Member>
constexpr Setting choice(std::string_view name, std::string_view help) {
  using Choice = std::remove_cvref_t<decltype(Methods{}.*Member)>;
  return {name, help, names_of<Choice>,
          [](std::string_view value, Methods& to) { return parse_choice(value, to.*Member); },
          [](const Methods& from) { return print_choice(from.*Member); }};
}

constexpr std::array table{
    choice<&Methods::collider>("collider", "how pieces find the terrain that they touch"),
    choice<&Methods::impacts>("impacts", "whether pieces that strike hard break again"),
    choice<&Methods::dents>("dents", "whether pieces that strike hard dent soft ground"),
    choice<&Methods::islands>("islands", "whether terrain that is cut off from the ground falls"),
    choice<&Methods::support>("support", "whether terrain too heavy for its neck breaks off; needs islands"),
    choice<&Methods::recombine>("recombine", "how pieces at rest become terrain again; off: never"),
    choice<&Methods::group_merges>("group-merges",
                                   "whether pieces that rest together become terrain in one pass"),
    choice<&Methods::cutter>("cutter", "how what breaks is cut into pieces"),
    choice<&Methods::simplifier>("simplifier", "which points of a piece's surface collide; none: all"),
};

/// Each member is bound by name: a new member that is not in the table does not compile.
constexpr size_t members() {
  const auto [collider, impacts, dents, islands, support, recombine, group_merges, cutter, simplifier] =
      Methods{};
  return std::array{static_cast<int>(collider),     static_cast<int>(impacts), static_cast<int>(dents),
                    static_cast<int>(islands),      static_cast<int>(support), static_cast<int>(recombine),
                    static_cast<int>(group_merges), static_cast<int>(cutter),  static_cast<int>(simplifier)}
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
