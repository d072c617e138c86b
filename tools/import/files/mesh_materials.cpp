#include "tools/import/files/mesh_materials.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "tools/import/limits.h"

namespace scree {

namespace {

/// Names that a sentence lists; more are counted by their absence.
constexpr size_t names_said_max = 8;

class NameList {
 public:
  void add(const std::string& name) {
    if (count_++ < names_said_max) text_ += (text_.empty() ? "" : ", ") + name;
  }
  size_t count() const { return count_; }
  std::string text() const { return text_ + (count_ > names_said_max ? ", …" : ""); }

 private:
  std::string text_;
  size_t count_ = 0;
};

std::string words_on(const MeshFile& file, const std::set<VoxelMaterial>& named,
                     const std::vector<VoxelMaterial>& rows, const SolidsImport& how,
                     const ImportPalette& import_palette) {
  const Palette& palette = import_palette.palette();
  NameList own, coloured, others;
  for (const VoxelMaterial one : named) own.add(std::string(palette.name(material_of(one))));
  for (size_t i = 0; i < rows.size(); ++i) {
    if (file.foreign[i].colour.weight == 0) continue;
    std::string name = "'" + file.foreign[i].colour.name + "'";
    if (const auto meant = import_palette.meant(file.foreign[i].colour.name))
      name += " (did you mean " + *meant + "?)";
    if (rows[i] != ground_own)
      coloured.add(fmt::format("{} as {}", name, palette.name(material_of(rows[i]))));
    else
      others.add(name);
  }
  std::string words;
  if (own.count() > 0) words += "; of the palette: " + own.text();
  if (coloured.count() > 0)
    words += fmt::format("; {} became rows of the palette by their colours: {} (--palette, --material-map)",
                         coloured.count() == 1 ? "a material of another name" : "materials of other names",
                         coloured.text());
  if (file.unread_textures > 0)
    words +=
        fmt::format("; {} picture{} of materials could not be read: PNG and JPEG in the file's folder can",
                    file.unread_textures, file.unread_textures == 1 ? "" : "s");
  if (others.count() == 0) return words;
  return words + fmt::format("; {} material{} of other names, {}: {} (--material)", others.count(),
                             others.count() == 1 ? "" : "s", others.text(),
                             how.material ? std::string(palette.name(*how.material))
                                          : "bulk, or the layers of the ground");
}

}  // namespace

MaterialMap names_of(const Palette& palette, const MaterialMap& map) {
  MaterialMap names = map;
  for (size_t i = 0; i < palette.rows.size(); ++i)
    names.emplace(palette.rows[i].name, static_cast<Material>(i));
  return names;
}

Result<std::string> give_materials(MeshFile& file, const SolidsImport& how, ImportPalette& palette) {
  auto& materials = file.mesh.materials;
  std::set<VoxelMaterial> named(materials.begin(), materials.end());
  named.erase(ground_own);
  std::vector<FileColour> colours;
  for (const MeshFile::Foreign& one : file.foreign) {
    colours.push_back(one.colour);
    if (!one.has_colour || how.material) colours.back().weight = 0;
  }
  const auto rows =
      TRY(rows_of_colours(colours, how.colour_rows_max.value_or(limits::mesh_colour_rows), palette));
  for (size_t i = 0; i < materials.size(); ++i)
    if (const uint16_t own = file.foreign_of[i]; own > 0) materials[i] = rows[own - 1];
  if (std::ranges::count(materials, ground_own) == std::ssize(materials)) materials.clear();
  return words_on(file, named, rows, how, palette);
}

}  // namespace scree
