// The uppermost metre of an elevation model's ground by a raster of land cover: each class is a material.
// Stored chunks hold it, near the surface alone.
#pragma once

#include <functional>
#include <string>

#include "ground/ground_file.h"
#include "tools/import/import_palette.h"
#include "tools/import/raster.h"

namespace scree {

/// What each cell's class is of, from the north-west, row by row; ground_own where it has none.
struct CoverGrid {
  int columns = 0;
  int rows = 0;
  double width_m = 0.0;  ///< 0: the file does not say
  double depth_m = 0.0;
  std::vector<VoxelMaterial> cells;
  uint64_t without = 0;  ///< cells without a class that the map has
};

/// `classes`: by the whole number of a class. The error says that the raster is too large, or holds numbers
/// that are no classes.
Result<CoverGrid> read_cover(Raster& raster, const MaterialMap& classes);

/// Refuses a cover of another place or size than the model, as far as both say it.
Result<void> check_same_place(Raster& cover, Raster& model, std::optional<double> model_cell_m);

struct CoverImport {
  double width_m = 0.0;  ///< of the elevation model, around the origin; the cover has as much
  double depth_m = 0.0;
  float reach_m = 1.0F;  ///< below the surface
  float voxel_size_m = 0.25F;
  std::shared_ptr<const Palette> palette{};  ///< not null
};

struct CoverImported {
  GroundHeader header;
  uint64_t bytes = 0;
  size_t chunks = 0;  ///< of the finest level
};

/// Makes a ground of the heights of another one. The error says that too many chunks would have to be stored.
Result<CoverImported> import_cover(std::shared_ptr<const GroundFile> heights, const CoverGrid& cover,
                                   const std::string& path, const CoverImport& how,
                                   const std::function<void(double)>& progress);

}  // namespace scree
