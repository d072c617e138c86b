#include "shared/material/palette.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

const MaterialRow& Palette::row(Material material) const {
  CHECK(has(material));
  return rows[row_number(material)];
}

const std::shared_ptr<const Palette>& plain_palette() {
  static const auto palette = [] {
    auto plain = std::make_shared<Palette>();
    plain->rows.emplace_back().name = "rock";
    plain->ground.soil = plain->ground.cap = plain->ground.bulk;
    return std::shared_ptr<const Palette>(std::move(plain));
  }();
  return palette;
}

std::optional<Material> Palette::named(std::string_view name) const {
  const auto found = std::ranges::find(rows, name, &MaterialRow::name);
  if (found == rows.end()) return std::nullopt;
  return static_cast<Material>(found - rows.begin());
}

std::vector<std::string_view> Palette::names() const {
  std::vector<std::string_view> names;
  for (const MaterialRow& one : rows) names.push_back(one.name);
  return names;
}

}  // namespace scree
