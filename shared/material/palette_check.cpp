// What a palette must keep, alone and beside the one that a world has.
#include <algorithm>
#include <set>

#include "shared/material/material_members.h"
#include "shared/material/palette.h"

namespace scree {

namespace {

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

Result<void> check_row(const MaterialRow& row) {
  for (const MaterialNumber& member : material_numbers()) TRY(check_number(member, member.get(row)));
  for (const MaterialChoice& member : material_choices())
    if (member.get(row) >= member.values.size())
      return fail(std::string(member.name) + " is not a known one (" + listed(member.values) + ")");
  return {};
}

/// Rubble names an earlier row, which is none: so no walk from rubble to stones goes in a circle.
Result<void> check_rubble(const Palette& palette, size_t number) {
  const MaterialRow& row = palette.rows[number];
  if (!row.rubble) return {};
  const size_t of = row_number(row.rubble->of);
  if (of >= number)
    return fail("it is rubble of material " + std::to_string(of) + ", which must come before it");
  if (palette.rows[of].rubble)
    return fail("it is rubble of " + palette.rows[of].name + ", which is rubble itself");
  if (row.loose) return fail("it is rubble, so it is not loose ground as well");
  if (row.rubble->fill < rubble_fill_min || row.rubble->fill > rubble_fill_max)
    return fail("the fill of rubble must lie between 0.25 and 0.99");
  return {};
}

Result<void> check_ground(const Palette& palette) {
  const GroundRows& ground = palette.ground;
  const auto check_layer = [&](Material layer, const char* what) -> Result<void> {
    if (palette.has(layer)) return {};
    return fail("ground: " + std::string(what) + " is material " + std::to_string(row_number(layer)) +
                ", and the palette has " + std::to_string(palette.rows.size()));
  };
  TRY(check_layer(ground.bulk, "bulk"));
  TRY(check_layer(ground.soil, "soil"));
  TRY(check_layer(ground.cap, "cap"));
  for (const GroundNumber& member : ground_numbers())
    if (const auto checked = check_number(member, member.get(ground)); !checked)
      return fail("ground: " + checked.error().message);
  return {};
}

}  // namespace

Result<void> check_material_name(std::string_view name) {
  const auto may_stand = [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty()) return fail("it has no name");
  if (name.size() > material_name_max)
    return fail("its name has " + std::to_string(name.size()) + " characters, over the limit of " +
                std::to_string(material_name_max));
  if (!is_letter(name.front()) || !std::ranges::all_of(name, may_stand))
    return fail("its name must begin with a letter, and have only a to z, 0 to 9 and _");
  return {};
}

Result<void> validate(const Palette& palette) {
  if (palette.rows.empty()) return fail("a palette has at least one material");
  if (palette.rows.size() > materials_max)
    return fail(std::to_string(palette.rows.size()) + " materials are over the limit of " +
                std::to_string(materials_max));
  std::set<std::string_view> names;
  for (size_t i = 0; i < palette.rows.size(); ++i) {
    const MaterialRow& row = palette.rows[i];
    if (const auto checked = check_material_name(row.name); !checked)
      return fail("material " + std::to_string(i) + ": " + checked.error().message);
    if (!names.insert(row.name).second) return fail(row.name + ": two materials have this name");
    if (const auto checked = check_row(row); !checked) return fail(row.name + ": " + checked.error().message);
  }
  for (size_t i = 0; i < palette.rows.size(); ++i)
    if (const auto checked = check_rubble(palette, i); !checked)
      return fail(palette.rows[i].name + ": " + checked.error().message);
  return check_ground(palette);
}

Result<void> validate_change(const Palette& before, const Palette& next) {
  TRY(validate(next));
  for (size_t i = 0; i < before.rows.size(); ++i) {
    const std::string& name = before.rows[i].name;
    if (i >= next.rows.size())
      return fail("material " + std::to_string(i) + " is " + name +
                  " so far, and the new palette has none: materials may be added, but not removed");
    if (next.rows[i].name != name)
      return fail("material " + std::to_string(i) + " is " + name + " so far, and " + next.rows[i].name +
                  " in the new palette: materials keep their numbers and names; new ones come last");
    if (next.rows[i].rubble != before.rows[i].rubble || next.rows[i].loose != before.rows[i].loose)
      return fail(name + ": what is rubble or loose stays so, with the same fill: its mass depends on it");
  }
  if (!(next.ground == before.ground))
    return fail("the new palette has another [ground] than so far, which decides the terrain");
  return {};
}

}  // namespace scree
