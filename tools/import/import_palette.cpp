#include "tools/import/import_palette.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

#include "shared/base/regular_file.h"
#include "shared/base/text.h"
#include "shared/material/material_members.h"
#include "shared/material/rubble.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr size_t shown_bytes_max = 80;

/// Lines of a map that are named one by one.
constexpr size_t unused_said_max = 8;

std::string without_blanks(std::string text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  text.erase(0, static_cast<size_t>(std::ranges::find_if_not(text, is_blank) - text.begin()));
  if (text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\''))
    text = text.substr(1, text.size() - 2);
  return text;
}

/// Lower case, _ for what may not stand in a name, and a letter first.
std::string tamed(const std::string& name) {
  std::string tame;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const char put = upper ? static_cast<char>(c - 'A' + 'a') : (kept ? c : '_');
    if (put != '_' || (!tame.empty() && tame.back() != '_')) tame += put;
  }
  while (!tame.empty() && tame.back() == '_') tame.pop_back();
  if (tame.empty() || !(tame.front() >= 'a' && tame.front() <= 'z')) tame.insert(0, 1, 'm');
  tame.resize(std::min(tame.size(), material_name_max));
  return tame;
}

}  // namespace

Result<std::vector<MapLine>> read_map_lines(const std::string& path, const Palette& palette) {
  TRY(check_is_small_file(path, limits::material_map_bytes_max));
  std::ifstream in(path);
  std::vector<MapLine> lines;
  std::set<std::string> names;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = without_blanks(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto wrong = [&](const std::string& why) {
      return fail(fmt::format("{}:{}: {}", path, number, why));
    };
    const size_t equals = line.rfind('=');
    if (equals == std::string::npos) return wrong("a line is NAME-or-NUMBER = material");
    const std::string from = without_blanks(line.substr(0, equals)),
                      to = without_blanks(line.substr(equals + 1));
    if (from.empty()) return wrong("there is no name before '=': a line is NAME-or-NUMBER = material");
    const auto material = palette.named(to);
    if (!material)
      return wrong("'" + showable(to, shown_bytes_max) + "' is no material of the palette (--materials)");
    if (!names.insert(from).second) return wrong("the same stands in a line before");
    lines.push_back({from, *material, number});
  }
  if (in.bad()) return fail(path + ": it cannot be read");
  return lines;
}

MaterialMap map_of(const std::vector<MapLine>& lines) {
  MaterialMap map;
  for (const MapLine& line : lines) map.emplace(line.name, line.material);
  return map;
}

std::vector<std::string> words_on_unused(const std::string& path, const std::vector<MapLine>& lines,
                                         const std::set<std::string>& used) {
  std::vector<std::string> words;
  size_t more = 0;
  for (const MapLine& line : lines) {
    if (used.contains(line.name)) continue;
    if (words.size() < unused_said_max)
      words.push_back(fmt::format("{}:{}: '{}' names no material of the imported rock", path, line.number,
                                  showable(line.name, shown_bytes_max)));
    else
      ++more;
  }
  if (more > 0) words.push_back(fmt::format("{}: {} more lines name none", path, more));
  return words;
}

Result<Material> ImportPalette::add(MaterialRow row) {
  if (palette_.rows.size() >= materials_max)
    return fail(
        fmt::format("its materials and those of the palette are more than {}: --material-map names "
                    "rows of the palette for them, --palette makes fewer",
                    materials_max));
  const std::string name = tamed(row.name);
  row.name = name;
  for (int i = 2; palette_.named(row.name); ++i) {
    const std::string suffix = fmt::format("_{}", i);
    row.name =
        fmt::format("{}{}", std::string_view(name).substr(0, material_name_max - suffix.size()), suffix);
  }
  palette_.rows.push_back(std::move(row));
  return static_cast<Material>(palette_.rows.size() - 1);
}

Result<Material> ImportPalette::add_if_new(const MaterialRow& row) {
  if (const auto own = palette_.named(row.name)) return *own;
  return add(row);
}

std::optional<std::string> ImportPalette::meant(const std::string& name) const {
  std::string tame = tamed(name);
  if (tame == name || !chosen_->named(tame)) return std::nullopt;
  return tame;
}

std::shared_ptr<const Palette> ImportPalette::result() const {
  return with_rubble(added() == 0 ? chosen_ : std::make_shared<const Palette>(palette_));
}

MaterialRow row_of_colour(std::string name, const std::array<float, 3>& linear) {
  MaterialRow row;
  row.name = std::move(name);
  row.look.variation = 0.05F;
  for (size_t i = 0; i < 3; ++i)
    row.look.colour[i] = std::isfinite(linear[i]) ? std::clamp(linear[i], 0.0F, 1.0F) : 0.0F;
  return row;
}

float linear_of_srgb(uint8_t part) {
  const float s = static_cast<float>(part) / 255.0F;
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

uint8_t srgb_of_linear(float part) {
  const float l = std::clamp(part, 0.0F, 1.0F);
  const float s = l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
  return static_cast<uint8_t>(std::lround(255.0F * s));
}

}  // namespace scree
