// An open file of GDAL, closed at its end.
#pragma once

#include <gdal_priv.h>
#include <memory>

namespace scree {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

}  // namespace scree
