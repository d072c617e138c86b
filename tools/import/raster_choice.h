// How a file of heights is read, where the file does not say it, says it wrong, or holds several rasters.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scree {

struct RasterChoice {
  std::string layer{};  ///< a raster of a file with several, or a file of an archive: its name or number
  std::optional<int> band{};     ///< from 1; default: the first one, and a picture is refused
  std::string crs{};             ///< overrides the file's: a code such as EPSG:32633, WKT or a PROJ string
  std::string vertical_unit{};   ///< overrides the file's
  std::vector<double> nodata{};  ///< stored values that are no heights, besides those that the file declares
  bool no_nodata = false;  ///< all values are heights, also those declared as none; masks still hide cells
};

}  // namespace scree
