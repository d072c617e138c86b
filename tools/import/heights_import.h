// Makes a ground file of a raster of heights. Reads it a few rows at a time: memory is bounded by its width,
// whatever its height.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ground/ground_header.h"
#include "shared/material/palette.h"
#include "tools/import/raster.h"

namespace scree {

struct HeightsImport {
  /// Distance of the raster's rows; columns keep their proportion. Default: as the file says.
  std::optional<double> cell_m{};
  std::optional<double> sample_m{};  ///< distance of the ground's samples; default: the cells'
  double vertical_scale = 1.0;
  std::optional<double> zero_m{};            ///< height that becomes y = 0, after the scale
  std::optional<double> fill_m{};            ///< height where the file has none; default: the lowest
  std::optional<double> soil_below_m{};      ///< heights in the world; default: all of the ground
  std::optional<double> ice_above_m{};       ///< default: none
  std::shared_ptr<const Palette> palette{};  ///< of the ground; null: the built-in one
};

struct HeightsImported {
  GroundHeader header;
  uint64_t bytes = 0;   ///< of the file
  uint64_t nodata = 0;  ///< cells of the raster without a height
  /// Sentences on what was done to the raster.
  std::vector<std::string> said;
  double lowest_m = 0.0;  ///< of the raster, after the scale
  double highest_m = 0.0;
  double volume_m3 = 0.0;  ///< above y = 0, of the whole raster
  /// Heights in the world, of every so-manieth sample.
  int preview_columns = 0;
  std::vector<float> preview_m;
  float preview_cell_m = 0.0F;
};

/// `progress(part)`: from 0 to 1. The error says what is wrong with the raster, and what may help.
Result<HeightsImported> import_heights(Raster& raster, const std::string& path, const HeightsImport& how,
                                       const std::function<void(double)>& progress);

/// A shaded relief in grey, lit from the north-west; as many pixels as there are heights.
std::vector<uint8_t> shaded_relief(const HeightsImported& imported);

}  // namespace scree
