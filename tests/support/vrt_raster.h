// Rasters for tests in the text form of GDAL, VRT, which says of a grid of numbers whatever a file can say;
// and a raster read as a whole. Import itself reads no VRT, as its files name others.
#pragma once

#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/test_folder.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/gdal/vrt_form.h"

namespace scree {

/// Cells, and how the file describes them.
struct VrtRaster {
  int columns = 0;
  int rows = 0;
  std::function<double(int, int)> stored{};  ///< of a column and a row of the file
  std::string head{};                        ///< elements of the whole: SRS, GeoTransform, GCPList, Metadata
  std::string band{};                        ///< elements of the band: NoDataValue, UnitType, ColorInterp
  std::string type = "Float32";
  std::string more{};  ///< further bands
};

/// The path of the file.
inline std::string write_vrt(const TestFolder& folder, const VrtRaster& raster) {
  std::ofstream grid(folder / "cells.asc");
  grid << "ncols " << raster.columns << "\nnrows " << raster.rows
       << "\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -123456\n";
  grid.precision(17);
  for (int z = 0; z < raster.rows; ++z)
    for (int x = 0; x < raster.columns; ++x)
      grid << raster.stored(x, z) << (x + 1 < raster.columns ? ' ' : '\n');
  const std::string path = folder / "raster.vrt";
  std::ofstream(path) << "<VRTDataset rasterXSize=\"" << raster.columns << "\" rasterYSize=\"" << raster.rows
                      << "\">" << raster.head << "<VRTRasterBand dataType=\"" << raster.type
                      << "\" band=\"1\">" << raster.band
                      << "<SimpleSource><SourceFilename relativeToVRT=\"1\">cells.asc</SourceFilename>"
                         "<OpenOptions><OOI key=\"DATATYPE\">Float64</OOI></OpenOptions>"
                         "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>"
                      << raster.more << "</VRTDataset>";
  return path;
}

struct WholeRaster {
  Raster::Shape shape{};
  std::optional<Raster::Place> place{};
  std::vector<double> heights_m{};
  std::string said{};
  std::string refusal{};  ///< empty: it was read

  double at(int column, int row) const {
    return heights_m[static_cast<size_t>(row) * static_cast<size_t>(shape.columns) +
                     static_cast<size_t>(column)];
  }
  bool says(const std::string& part) const { return said.find(part) != std::string::npos; }
  bool refuses(const std::string& part) const { return refusal.find(part) != std::string::npos; }
};

inline WholeRaster read_whole(Raster& raster) {
  WholeRaster whole;
  whole.shape = raster.shape();
  whole.place = raster.place();
  Result<void> read = raster.check_values([](double) {});
  std::vector<double> row(static_cast<size_t>(whole.shape.columns));
  for (int z = 0; read && z < whole.shape.rows; ++z) {
    read = raster.read_row(z, row);
    whole.heights_m.insert(whole.heights_m.end(), row.begin(), row.end());
  }
  for (const std::string& line : raster.said()) whole.said += line + "\n";
  if (!read) whole.refusal = read.error().message;
  return whole;
}

inline WholeRaster read_whole(const std::string& path, const RasterChoice& choice = {}) {
  std::optional<VrtForm> form;
  if (path.ends_with(".vrt")) form.emplace();
  const auto raster = open_raster(path, choice);
  if (raster) return read_whole(**raster);
  WholeRaster none;
  none.refusal = raster.error().message;
  return none;
}

}  // namespace scree
