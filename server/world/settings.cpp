#include "server/world/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "server/work/limits.h"
#include "server/world/limits.h"
#include "shared/base/check.h"
#include "shared/base/kind_table.h"
#include "shared/base/limits.h"
#include "shared/base/listed.h"
#include "shared/operation/store_limits.h"

namespace scree {

namespace {

constexpr std::array<std::string_view, 2> bool_names{"false", "true"};

/// The names of a choice's values, in their order.
template <typename Choice>
constexpr std::span<const std::string_view> names_of() {
  if constexpr (std::is_same_v<Choice, bool>)
    return bool_names;
  else
    return kind_names<Choice>;
}

/// The member that a pointer names, wherever in the config its struct lies.
template <typename Value>
auto& member(auto& config, Value Methods::*of) {
  return config.methods.*of;
}
template <typename Value>
auto& member(auto& config, Value WorldConfig::*of) {
  return config.*of;
}
template <typename Value>
auto& member(auto& config, Value ServiceLimits::*of) {
  return config.service.*of;
}

template <auto Member>
using ValueOf = std::remove_cvref_t<decltype(member(std::declval<WorldConfig&>(), Member))>;

template <auto Member>
double get_member(const WorldConfig& config) {
  return static_cast<double>(member(config, Member));
}
template <auto Member>
void put_member(WorldConfig& config, double value) {
  if constexpr (std::is_enum_v<ValueOf<Member>>)
    member(config, Member) = static_cast<ValueOf<Member>>(static_cast<int>(value));
  else
    member(config, Member) = static_cast<ValueOf<Member>>(value);
}

/// A row of the table, for a member whose type has names_of.
template <auto Member>
constexpr Setting choice(std::string_view name, std::string_view help) {
  const std::span<const std::string_view> names = names_of<ValueOf<Member>>();
  return {name, help, names, {}, names, get_member<Member>, put_member<Member>};
}

/// The same where the network's side alone goes by it: no simulation differs.
template <auto Member>
constexpr Setting choice_of_service(std::string_view name, std::string_view help) {
  Setting row = choice<Member>(name, help);
  row.tried = {};
  return row;
}

template <auto Member>
constexpr Setting number(std::string_view name, std::string_view help, NumberBounds bounds,
                         std::span<const std::string_view> tried = {}) {
  return {name, help, {}, bounds, tried, get_member<Member>, put_member<Member>};
}

/// The same of a limit of the machine.
template <auto Member>
constexpr Setting machine_limit(std::string_view name, std::string_view help, NumberBounds bounds,
                                std::span<const std::string_view> tried = {}) {
  Setting row = number<Member>(name, help, bounds, tried);
  row.of_machine = true;
  return row;
}

constexpr Setting text(std::string_view name, std::string_view help, const TextForm& form) {
  return {name, help, {}, {}, {}, nullptr, nullptr, form};
}

constexpr std::string_view auto_spawn = "auto";

Result<void> parse_spawn_choice(WorldConfig& config, std::string_view value) {
  if (value == auto_spawn)
    config.spawn.reset();
  else
    config.spawn = TRY(parse_spawn(value));
  return {};
}
std::string print_spawn_choice(const WorldConfig& config) {
  return config.spawn ? text_of(*config.spawn) : std::string(auto_spawn);
}

Result<void> parse_water_choice(WorldConfig& config, std::string_view value) {
  config.water = TRY(parse_water(value));
  return {};
}
std::string print_water_choice(const WorldConfig& config) {
  return text_of_water(config.water);
}

constexpr std::array<std::string_view, 2> few_pieces{"12", "20"};
constexpr std::array<std::string_view, 1> little_work{"20"};
constexpr std::array<std::string_view, 1> some_drag{"5"};

constexpr std::array table{
    choice<&Methods::collider>("collider", "how pieces find the terrain that they touch"),
    choice<&Methods::impacts>("impacts", "whether pieces that strike hard break again"),
    choice<&Methods::dents>("dents", "whether pieces that strike hard dent soft ground"),
    choice<&Methods::islands>("islands", "whether terrain that is cut off from the ground falls"),
    choice<&Methods::support>("support", "whether terrain too heavy for its neck breaks off; needs islands"),
    choice<&Methods::recombine>("recombine", "how pieces at rest become terrain again; off: never"),
    choice<&Methods::group_merges>("group-merges",
                                   "whether pieces that rest together become terrain in one pass"),
    choice<&Methods::cutter>("cutter", "how broken rock is divided into pieces"),
    choice<&Methods::simplifier>("simplifier", "which points of a piece's surface collide; none: all"),
    number<&WorldConfig::air_drag_percent>("air-drag",
                                           "the part of their speed that pieces lose to the air in a second",
                                           {0, limits::air_drag_max_percent, "percent"}, some_drag),
    machine_limit<&WorldConfig::pieces_max>("pieces-max", "pieces alive at once; further carves are refused",
                                            {limits::pieces_max_min, limits::pieces_max_max, "pieces"},
                                            few_pieces),
    machine_limit<&WorldConfig::props_max>("props-max", "props there at once; further ones are refused",
                                           {0, limits::props_max_max, "props"}),
    machine_limit<&WorldConfig::joints_max>("joints-max", "joints there at once; further ones are refused",
                                            {0, limits::joints_max_max, "joints"}),
    machine_limit<&WorldConfig::memory_max_mb>(
        "memory-max", "memory of the terrain and the program; further edits are refused",
        {limits::memory_max_min_mb, limits::memory_max_max_mb, "megabytes"}),
    machine_limit<&WorldConfig::work_percent>(
        "work-percent", "the part of a tick's length that its work may take; lowered while ticks are late",
        {limits::work_percent_min, limits::work_percent_max, "percent"}, little_work),
    machine_limit<&ServiceLimits::sessions_max>(
        "sessions-max",
        "clients at once; when full, the server drops an idle client, or "
        "one without a token if the newcomer has one",
        {1, limits::sessions_max_max, "clients"}),
    machine_limit<&ServiceLimits::requests_per_second>(
        "requests-per-second", "carves, fills and paints of one client; more are refused",
        {limits::requests_per_second_min, limits::requests_per_second_max, "requests a second", false}),
    text(spawn_setting, "where visitors begin, and which way they look; auto: where the ground suggests",
         {"auto or X,Y,Z or X,Y,Z,YAW,PITCH, metres and degrees", parse_spawn_choice, print_spawn_choice}),
    number<&ServiceLimits::reach_m>(
        "reach", "how far from its eye a client may edit, metres; 0 and administrators: anywhere",
        {limits::reach_min_m, limits::reach_max_m, "metres", false}),
    choice_of_service<&ServiceLimits::sight>(
        sight_setting,
        "whether an edit has to be in sight of its client's eye; administrators edit anything"),
    choice<&ServiceLimits::persons>(
        persons_setting,
        "how persons are in the world; walk: with bodies, which the server moves by their input"),
    text(water_setting,
         "how high the water stands that is drawn, metres; it does not flow, and carries nothing",
         {"off or a height within the world, metres", parse_water_choice, print_water_choice}),
    number<&WorldConfig::store_m3>("store-m3", "rock that a person carries; 0: nobody digs",
                                   {0, limits::store_max_m3, "cubic metres"}),
    number<&WorldConfig::dig_m3_per_s>("dig-m3-per-s",
                                       "digging into one store, cubic metres a second; 0: no limit",
                                       {0, limits::dig_max_m3_per_s, "cubic metres a second"}),
};

/// Each member is bound by name: a new member that is not in the table does not compile. The terrain, the
/// tick's length and merges_per_tick_max of a WorldConfig are fixed from the start.
[[maybe_unused]] auto members(const WorldConfig& world) {
  const auto& [terrain, tick_rate_hz, pieces_max, props_max, joints_max, memory_max_mb, merges_per_tick_max,
               work_percent, store_m3, dig_m3_per_s, air_drag_percent, methods, service, spawn, water, ground,
               rules, palette, material_numbers] = world;
  static_cast<void>(ground);  // names the terrain's
  static_cast<void>(rules);   // fixed from the start, as these three
  static_cast<void>(palette);
  static_cast<void>(material_numbers);  // a setting each (material_settings.h)
  const auto& [collider, impacts, dents, islands, support, recombine, group_merges, cutter, simplifier] =
      methods;
  const auto& [sessions_max, requests_per_second, reach_m, sight, persons] = service;
  constexpr size_t fixed = 3;
  const std::array config{static_cast<double>(terrain.voxel_size_m),
                          static_cast<double>(tick_rate_hz),
                          static_cast<double>(pieces_max),
                          static_cast<double>(props_max),
                          static_cast<double>(joints_max),
                          static_cast<double>(memory_max_mb),
                          static_cast<double>(merges_per_tick_max),
                          static_cast<double>(work_percent),
                          static_cast<double>(store_m3),
                          static_cast<double>(dig_m3_per_s),
                          static_cast<double>(air_drag_percent)};
  const std::array choices{
      static_cast<int>(collider),     static_cast<int>(impacts), static_cast<int>(dents),
      static_cast<int>(islands),      static_cast<int>(support), static_cast<int>(recombine),
      static_cast<int>(group_merges), static_cast<int>(cutter),  static_cast<int>(simplifier)};
  const std::array granted{static_cast<double>(sessions_max), requests_per_second, reach_m,
                           static_cast<double>(sight), static_cast<double>(persons)};
  constexpr size_t texts = 2;  // spawn, water
  static_cast<void>(spawn);
  static_cast<void>(water);
  return std::integral_constant<size_t, config.size() - fixed + choices.size() + granted.size() + texts>{};
}
static_assert(decltype(members(std::declval<const WorldConfig&>()))::value == table.size());

/// The shortest text that is read as this number: without an exponent, where that has room.
std::string text_of(double number) {
  std::array<char, 32> text{};
  char* const end = text.data() + text.size();
  auto printed = std::to_chars(text.data(), end, number, std::chars_format::fixed);
  if (printed.ec != std::errc()) printed = std::to_chars(text.data(), end, number);
  CHECK(printed.ec == std::errc());
  return {text.data(), printed.ptr};
}

Result<double> parse_number(std::string_view value, const NumberBounds& bounds) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_number = error == std::errc() && end == value.data() + value.size();
  const bool within = number >= bounds.min && number <= bounds.max;
  if (!is_number || !within || (bounds.whole && number != std::floor(number))) return fail("out of bounds");
  return number + 0.0;  // no −0
}

Result<void> read(const Setting& setting, std::string_view value, WorldConfig& config) {
  if (setting.is_text()) {
    if (const Result<void> done = setting.text.parse(config, value); !done)
      return fail("is " + setting.may_be() + "; " + done.error().message);
    return {};
  }
  if (setting.choices.empty()) {
    const Result<double> number = parse_number(value, setting.bounds);
    if (!number) return fail("is " + setting.may_be());
    setting.put(config, *number);
    return {};
  }
  const auto found = std::ranges::find(setting.choices, value);
  if (found == setting.choices.end()) return fail("is " + setting.may_be());
  setting.put(config, static_cast<double>(found - setting.choices.begin()));
  return {};
}

}  // namespace

std::string Setting::may_be() const {
  if (is_text()) return std::string(text.may_be);
  if (choices.empty())
    return text_of(bounds.min) + " to " + text_of(bounds.max) + " " + std::string(bounds.unit) +
           (bounds.whole ? ", whole" : "");
  return listed(choices);
}

/// A world has what its files and its clients read: the value as it is printed, which may have fewer digits.
Result<void> Setting::parse(std::string_view value, WorldConfig& config) const {
  TRY(read(*this, value, config));
  return read(*this, print(config), config);
}

std::string Setting::print(const WorldConfig& config) const {
  if (is_text()) return text.print(config);
  const double value = get(config);
  return choices.empty() ? text_of(value) : std::string(choices[static_cast<size_t>(value)]);
}

std::span<const Setting> settings() {
  return table;
}

Result<void> set(WorldConfig& config, const SettingValue& setting) {
  if (is_material_setting(setting.name))
    return set_material(*config.palette, config.material_numbers, setting);
  const auto row = std::ranges::find(table, setting.name, &Setting::name);
  if (row == table.end()) {
    std::string names;
    for (const Setting& known : table) names += (names.empty() ? "" : ", ") + std::string(known.name);
    return fail("there is no setting '" + setting.name + "'; there are " + names + " and " +
                std::string(material_prefix) + "ROW.MEMBER");
  }
  const Result<void> parsed = row->parse(setting.value, config);
  if (!parsed) return fail(setting.name + " " + parsed.error().message + ", not '" + setting.value + "'");
  return {};
}

Result<void> set_all(WorldConfig& config, const SettingValues& values) {
  if (values.size() > limits::settings_max)
    return fail("more than " + std::to_string(limits::settings_max) +
                " settings at once (limits.settings_max)");
  WorldConfig changed = config;
  for (auto value = values.begin(); value != values.end(); ++value) {
    if (std::ranges::find(values.begin(), value, value->name, &SettingValue::name) != value)
      return fail(value->name + " is set twice");
    TRY(set(changed, *value));
  }
  TRY(check_together(changed));
  config = changed;
  return {};
}

Result<void> check_together(const WorldConfig& config) {
  if (config.methods.support && !config.methods.islands)
    return fail(
        "support needs islands, which make broken terrain fall: set islands=true, too, or support=false");
  return {};
}

SettingValues print(const WorldConfig& config) {
  SettingValues values;
  for (const Setting& setting : table) values.push_back({std::string(setting.name), setting.print(config)});
  const SettingValues materials = print(config.material_numbers);
  values.insert(values.end(), materials.begin(), materials.end());
  return values;
}

SettingValues differing(const SettingValues& values, const WorldConfig& config) {
  const SettingValues now = print(config);
  SettingValues others;
  for (const SettingValue& value : values)
    if (std::ranges::find(now, value) == now.end()) others.push_back(value);
  return others;
}

}  // namespace scree
