// Which band of a file holds heights. Pictures, palettes and classes are none.
#pragma once

#include <optional>
#include <string>

#include "shared/base/result.h"
#include "tools/import/gdal/dataset.h"

namespace scree {

struct HeightBandChoice {
  GDALRasterBand* band = nullptr;
  std::string words;
};

/// The chosen band, from 1, whatever it holds but complex numbers; without a choice, the first that can be
/// heights. The error names what the file holds instead.
Result<HeightBandChoice> choose_height_band(GDALDataset& dataset, std::optional<int> chosen);

}  // namespace scree
