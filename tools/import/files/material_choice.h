// The palette that names in files refer to, as the command line chooses it.
#pragma once

#include <string>
#include <vector>

#include "ground/ground_file.h"
#include "tools/import/import_palette.h"

namespace scree {

struct MaterialOptions {
  std::string palette;  ///< a file (content/palette_text.h); empty: that of the ground below, or the built-in
  std::string map;      ///< a file (read_map_lines); empty: none
  std::string material;  ///< a name; empty: none
};

struct ChosenMaterials {
  std::shared_ptr<const Palette> palette;
  std::vector<MapLine> map{};
  std::optional<Material> material{};
  std::vector<std::string> said{};  ///< sentences on what was left out
};

/// `on`: the ground below, whose rows the palette must have; null: none.
Result<ChosenMaterials> read_choice(const MaterialOptions& options, const GroundFile* on);

}  // namespace scree
