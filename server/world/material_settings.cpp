#include "server/world/material_settings.h"

#include <array>
#include <charconv>
#include <optional>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/near_name.h"
#include "shared/material/material_members.h"

namespace scree {

namespace {

constexpr size_t mistyped_max = 2;

std::string text_of(float number) {
  std::array<char, 64> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

std::optional<float> number_in(std::string_view text) {
  float number = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A number's place in a palette.
struct Place {
  Material row{};
  std::string_view member;
};

Result<Place> place_of(const Palette& palette, std::string_view key) {
  const size_t point = key.find('.');
  const std::string_view row = key.substr(0, point);
  if (point == std::string_view::npos)
    return fail("'" + std::string(key) + "' names no number: write " + std::string(material_prefix) +
                "ROW.MEMBER, such as " + std::string(material_prefix) + palette.rows.front().name +
                ".strength");
  const auto material = palette.named(row);
  if (material) return Place{*material, key.substr(point + 1)};
  const std::vector<std::string_view> names = palette.names();
  return fail("this world has no material '" + std::string(row) + "'" +
              did_you_mean(row, std::vector<std::string>(names.begin(), names.end()), mistyped_max));
}

Result<void> put(Palette& palette, std::string_view key, float number) {
  const auto place = TRY(place_of(palette, key));
  MaterialRow& row = palette.rows[row_number(place.row)];
  if (const Result<void> done = set_number(row, place.member, number); !done)
    return fail(row.name + ": " + done.error().message);
  return {};
}

}  // namespace

Result<void> set_material(const Palette& own, MaterialNumbers& numbers, const SettingValue& setting) {
  CHECK(is_material_setting(setting.name));
  const std::string key = setting.name.substr(material_prefix.size());
  const auto place = TRY(place_of(own, key));
  MaterialRow row = own.row(place.row);
  const std::optional<float> before = number_of(row, place.member);
  const bool is_own = setting.value == own_number;
  const std::optional<float> number = is_own && before ? before : number_in(setting.value);
  // An unknown member is refused by its name, whatever the value is.
  if (const auto done = set_number(row, place.member, number.value_or(before.value_or(0.0F))); !done)
    return fail(row.name + ": " + done.error().message);
  if (!number)
    return fail(row.name + ": " + std::string(place.member) + " is a number or " + std::string(own_number) +
                ", not '" + setting.value + "'");
  if (*number == *before) {
    numbers.erase(key);
    return {};
  }
  if (!numbers.contains(key) && numbers.size() >= limits::material_settings_max)
    return fail(std::to_string(limits::material_settings_max) +
                " numbers of materials are changed already (limits.material_settings_max): put them into the "
                "palette's file (--materials), or set others to " +
                std::string(own_number));
  numbers[key] = *number;
  return {};
}

SettingValues print(const MaterialNumbers& numbers) {
  SettingValues values;
  for (const auto& [key, number] : numbers)
    values.push_back({std::string(material_prefix) + key, text_of(number)});
  return values;
}

std::shared_ptr<const Palette> palette_with(const std::shared_ptr<const Palette>& own,
                                            const MaterialNumbers& numbers) {
  if (numbers.empty()) return own;
  auto changed = std::make_shared<Palette>(*own);
  for (const auto& [key, number] : numbers) CHECK(put(*changed, key, number));
  return changed;
}

std::shared_ptr<const Palette> palette_with(const std::shared_ptr<const Palette>& own,
                                            const SettingValues& settings) {
  MaterialNumbers numbers;
  for (const SettingValue& setting : settings) {
    if (!is_material_setting(setting.name)) continue;
    if (!set_material(*own, numbers, setting)) continue;
  }
  return palette_with(own, numbers);
}

}  // namespace scree
