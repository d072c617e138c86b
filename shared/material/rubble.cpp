#include "shared/material/rubble.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"
#include "shared/material/material_members.h"

namespace scree {

namespace {

bool is_rubble(const MaterialRow& row) {
  return row.rubble.has_value();
}

/// The first row that is rubble of a row; nothing where there is none.
std::optional<Material> rubble_of(const Palette& palette, Material stones) {
  for (size_t i = 0; i < palette.rows.size(); ++i)
    if (const auto& rubble = palette.rows[i].rubble; rubble && rubble->of == stones)
      return static_cast<Material>(i);
  return std::nullopt;
}

/// How far two rows are from each other, for who has to take one for the other.
float unlikeness(const MaterialRow& a, const MaterialRow& b) {
  float sum = std::abs(a.density_kg_m3 - b.density_kg_m3) / 1000.0F;
  for (size_t i = 0; i < 3; ++i) sum += std::abs(a.look.colour[i] - b.look.colour[i]);
  return sum;
}

std::string name_of_rubble(const Palette& palette, const std::string& stones) {
  constexpr std::string_view ending = "_rubble";
  std::string name = stones.substr(0, material_name_max - ending.size()) + std::string(ending);
  for (int again = 2; palette.named(name); ++again) {
    const std::string number = std::to_string(again);
    name = stones.substr(0, material_name_max - ending.size() - number.size()) + std::string(ending) + number;
  }
  return name;
}

/// What a heap of broken stones bears. Pressed: thrice what BS 8004 (1986, table 1) allows on dense gravel,
/// 600 kPa. The others are chosen: angular stones interlock as if they had a cohesion of some 50 kPa, so that
/// a lump of a metre holds where it hangs over.
constexpr Bearing interlocked{
    .pressed_pa = 1.8e6F, .hanging_pa = 2.0e4F, .sideways_pa = 5.0e4F, .bending_pa = 5.0e4F};

/// Rubble of a row: its stones, lying loosely. It dents as gravel does, its angle of repose is 38°, and it
/// looks like stones of that row.
MaterialRow derived(const Palette& palette, Material stones) {
  MaterialRow row = palette.row(stones);
  row.name = name_of_rubble(palette, row.name);
  row.rubble = RubbleOf{.of = stones};
  row.friction = 0.78F;
  row.restitution = 0.0F;
  row.strength_m_s = std::min(row.strength_m_s, 2.0F);
  row.strength_by_size = 0.0F;
  row.breaks = BreakLook::even;
  row.dent_resistance_j_m3 = std::min(row.dent_resistance_j_m3, 4.0e5F);
  row.bearing = {std::min(row.bearing.pressed_pa, interlocked.pressed_pa),
                 std::min(row.bearing.hanging_pa, interlocked.hanging_pa),
                 std::min(row.bearing.sideways_pa, interlocked.sideways_pa),
                 std::min(row.bearing.bending_pa, interlocked.bending_pa)};
  row.sound = {row.sound.pitch, std::min(row.sound.damping_s, 0.01F), std::max(row.sound.noise, 0.9F)};
  row.look.variation = std::min(1.0F, row.look.variation + 0.2F);
  row.look.roughness = std::max(row.look.roughness, 0.95F);
  row.look.albedo.reset();
  row.look.normal.reset();
  return row;
}

}  // namespace

Rubble::Rubble() {
  static const auto none = std::make_shared<const RubbleRows>();
  rows_ = none;
}

RubbleRows::RubbleRows() {
  fill.fill(static_cast<uint8_t>(fill_solid));
  for (size_t i = 0; i < rubble.size(); ++i) rubble[i] = stones[i] = static_cast<Material>(i);
}

RubbleRows rubble_rows(const Palette& palette) {
  RubbleRows rows;
  std::vector<Material> rubble;
  for (size_t i = 0; i < palette.rows.size(); ++i) {
    const auto& of = palette.rows[i].rubble;
    if (!of) continue;
    rows.any = true;
    rows.fill[i] = of->fill;
    rows.stones[i] = of->of;
    rubble.push_back(static_cast<Material>(i));
  }
  if (!rows.any) return rows;
  for (size_t i = 0; i < palette.rows.size(); ++i) {
    const MaterialRow& row = palette.rows[i];
    if (is_rubble(row) || row.loose) continue;
    const auto like = [&](Material one) {
      return unlikeness(row, palette.row(rows.stones[row_number(one)]));
    };
    rows.rubble[i] =
        rubble_of(palette, static_cast<Material>(i)).value_or(*std::ranges::min_element(rubble, {}, like));
  }
  return rows;
}

void add_rubble(Palette& palette) {
  const size_t given = palette.rows.size();
  for (size_t i = 0; i < given && palette.rows.size() < materials_max; ++i) {
    const auto stones = static_cast<Material>(i);
    if (is_rubble(palette.rows[i]) || palette.rows[i].loose || rubble_of(palette, stones)) continue;
    palette.rows.push_back(derived(palette, stones));
  }
  CHECK(palette.rows.size() <= materials_max);
}

std::shared_ptr<const Palette> with_rubble(const std::shared_ptr<const Palette>& palette) {
  Palette more = *palette;
  add_rubble(more);
  return more.rows.size() == palette->rows.size() ? palette
                                                  : std::make_shared<const Palette>(std::move(more));
}

Palette numbered_as(const Palette& kept, const Palette& next) {
  std::vector<size_t> order;  // of next's rows
  std::vector<bool> taken(next.rows.size());
  const auto take = [&](size_t row) {
    order.push_back(row);
    taken[row] = true;
  };
  for (const MaterialRow& row : kept.rows) {
    size_t at = 0;
    if (is_rubble(row))
      at = next.named(row.name) ? row_number(*next.named(row.name)) : next.rows.size();
    else
      while (at < next.rows.size() && (taken[at] || is_rubble(next.rows[at]))) ++at;
    if (at == next.rows.size() || taken[at]) return next;
    take(at);
  }
  for (size_t row = 0; row < next.rows.size(); ++row)
    if (!taken[row]) take(row);
  std::vector<Material> number(order.size());
  for (size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<Material>(i);
  Palette numbered;
  for (const size_t row : order) {
    MaterialRow& added = numbered.rows.emplace_back(next.rows[row]);
    if (added.rubble) added.rubble->of = number[row_number(added.rubble->of)];
  }
  numbered.ground = next.ground;
  for (Material GroundRows::*layer : {&GroundRows::bulk, &GroundRows::soil, &GroundRows::cap})
    numbered.ground.*layer = number[row_number(next.ground.*layer)];
  return numbered;
}

}  // namespace scree
