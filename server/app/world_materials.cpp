#include "server/app/world_materials.h"

#include <set>

#include "content/builtin_palette.h"
#include "content/files/palette_file.h"
#include "server/log/log.h"
#include "shared/material/rubble.h"

namespace scree {

Result<void> set_materials(const std::string& path, LiveConfig& config) {
  auto content = TRY(read_palette_file(path));
  WorldConfig& world = config.world;
  // Stored bricks name their materials by number, as a kept world does.
  if (world.terrain.heights != nullptr && world.terrain.heights->bricks())
    if (const auto may =
            validate_change(*world.palette, content.palette = numbered_as(*world.palette, content.palette));
        !may)
      return fail(path +
                  ": it must have all rows of the ground, whose bricks are of them: " + may.error().message);
  config.materials = std::make_shared<const Palette>(std::move(content.palette));
  config.images = std::make_shared<const ContentFiles>(std::move(content.files));
  world.palette = config.materials;
  world.terrain.rows = config.materials->ground;
  return {};
}

Result<void> give_materials(RecordedHeader& header, const std::shared_ptr<const Palette>& materials) {
  if (materials == nullptr) return {};
  const Palette& kept = header.palette ? *header.palette : builtin_palette();
  auto next = std::make_shared<const Palette>(numbered_as(kept, *materials));
  if (const auto may = validate_change(kept, *next); !may)
    return fail(may.error().message +
                " (--materials); the world keeps its own materials without that option");
  header.palette = std::move(next);
  return {};
}

void tell_missing_images(const Palette& palette, const ContentFiles* images) {
  std::set<Digest> missing;
  for (const MaterialRow& row : palette.rows)
    for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal})
      if (image && (images == nullptr || !images->contains(*image))) missing.insert(*image);
  if (missing.empty()) return;
  log_of(LogPart::content)
      .info(
          "{} images that this world's materials name are not here, and clients draw these without: give the "
          "file "
          "of the materials (--materials)",
          missing.size());
}

}  // namespace scree
