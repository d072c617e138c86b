// Few rows of a palette for many colours: median cut.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/import/import_palette.h"

namespace scree {

/// A material of a file that is none of the palette's.
struct FileColour {
  std::string name;
  std::array<float, 3> linear{};
  uint64_t weight = 0;  ///< triangles or voxels that are of it; 0: it gets no row
};

/// What each colour becomes: ground_own for those without weight. At most `rows_max` rows are added, each
/// named after the colour in it that weighs most, of the mean colour. The same colours make the same rows.
Result<std::vector<VoxelMaterial>> rows_of_colours(const std::vector<FileColour>& colours, size_t rows_max,
                                                   ImportPalette& palette);

}  // namespace scree
