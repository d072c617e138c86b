#include "tools/import/files/material_choice.h"

#include "content/builtin_palette.h"
#include "content/files/palette_file.h"

namespace scree {

namespace {

/// A ground has no images: who serves it names the palette's file, too.
Palette without_images(Palette palette, const std::string& path, std::vector<std::string>& said) {
  bool any = false;
  for (MaterialRow& row : palette.rows) {
    any = any || row.look.albedo || row.look.normal;
    row.look.albedo = row.look.normal = std::nullopt;
  }
  if (any) said.push_back(path + ": its images are left out: a ground file has colours alone");
  return palette;
}

}  // namespace

Result<ChosenMaterials> read_choice(const MaterialOptions& options, const GroundFile* on) {
  ChosenMaterials choice;
  choice.palette = on != nullptr ? on->palette() : shared_builtin_palette();
  if (!options.palette.empty()) {
    PaletteContent content = TRY(read_palette_file(options.palette));
    auto chosen = std::make_shared<const Palette>(
        without_images(std::move(content.palette), options.palette, choice.said));
    if (on != nullptr)
      if (auto valid = validate_change(*choice.palette, *chosen); !valid)
        return fail(options.palette +
                    ": it must have all rows of the ground below (--on): " + valid.error().message);
    choice.palette = std::move(chosen);
  }
  if (!options.map.empty()) choice.map = TRY(read_map_lines(options.map, *choice.palette));
  if (options.material.empty()) return choice;
  choice.material = choice.palette->named(options.material);
  if (choice.material) return choice;
  std::string names;
  for (const std::string_view name : choice.palette->names())
    names += (names.empty() ? "" : ", ") + std::string(name);
  return fail("--material: '" + options.material + "' is no material of the palette; it has " + names);
}

}  // namespace scree
