#include "tools/import/vdb/vdb_materials.h"

#include <fmt/format.h>

#include "proto/palette_codec.h"

namespace scree {

namespace {

std::vector<std::string> lines_of(std::span<const uint8_t> text) {
  std::vector<std::string> lines;
  std::string line;
  for (const uint8_t byte : text) {
    if (byte != '\n') {
      line += static_cast<char>(byte);
      continue;
    }
    lines.push_back(std::move(line));
    line.clear();
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

std::optional<uint8_t> digit_of(uint8_t c) {
  if (c >= '0' && c <= '9') return static_cast<uint8_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<uint8_t>(c - 'a' + 10);
  return std::nullopt;
}

/// The palette of the file; one without rows where it has none that can be read.
Palette packed_palette(std::span<const uint8_t> digits) {
  std::vector<uint8_t> bytes;
  for (size_t i = 0; i + 1 < digits.size(); i += 2) {
    const auto high = digit_of(digits[i]), low = digit_of(digits[i + 1]);
    if (!high || !low) return {};
    bytes.push_back(static_cast<uint8_t>(*high * 16 + *low));
  }
  auto palette = decode_palette(bytes);
  return palette ? std::move(*palette) : Palette{};
}

}  // namespace

Result<std::vector<VoxelMaterial>> rows_of_numbers(std::span<const uint8_t> names,
                                                   std::span<const uint8_t> packed,
                                                   const std::set<int32_t>& occurring, const MaterialMap& map,
                                                   ImportPalette& palette, std::set<std::string>& map_used) {
  std::vector<VoxelMaterial> rows;
  const std::vector<std::string> lines = lines_of(names);
  if (lines.size() > materials_max)
    return fail(
        fmt::format("its grid of materials names {} of them, more than {}", lines.size(), materials_max));
  const Palette of_file = packed_palette(packed);
  for (size_t i = 0; i < (lines.empty() ? materials_max : lines.size()); ++i) {
    if (!occurring.contains(static_cast<int32_t>(i))) {
      rows.push_back(ground_own);
      continue;
    }
    const std::string name = lines.empty() ? std::string() : lines[i];
    auto mapped = map.find(std::to_string(i));
    if (mapped == map.end()) mapped = map.find(name);
    if (mapped != map.end()) {
      map_used.insert(mapped->first);
      rows.push_back(said(mapped->second));
    } else if (lines.empty()) {
      const bool is_row = i < palette.palette().rows.size();
      rows.push_back(is_row ? said(static_cast<Material>(i)) : ground_own);
    } else {
      const auto own = of_file.named(name);
      const Material row =
          TRY(palette.add_if_new(own ? of_file.row(*own) : row_of_colour(name, {0.5F, 0.5F, 0.5F})));
      rows.push_back(said(row));
    }
  }
  return rows;
}

}  // namespace scree
