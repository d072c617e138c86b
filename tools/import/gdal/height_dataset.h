// A raster of GDAL's whose one band holds the heights of another one, in metres, NaN where there are none:
// GDAL's warper reads it like any file. It lies on the map where the other one lies.
#pragma once

#include <ogr_spatialref.h>

#include "tools/import/gdal/height_values.h"

namespace scree {

class HeightDataset final : public GDALDataset {
 public:
  /// `source`, `values` of one of its bands, and `crs` outlive it. `crs` may be null.
  HeightDataset(GDALDataset& source, HeightValues& values, const OGRSpatialReference* crs);

  CPLErr GetGeoTransform(double* transform) override;
  const OGRSpatialReference* GetSpatialRef() const override { return crs_; }
  int GetGCPCount() override { return source_.GetGCPCount(); }
  const GDAL_GCP* GetGCPs() override { return source_.GetGCPs(); }
  const OGRSpatialReference* GetGCPSpatialRef() const override { return crs_; }
  char** GetMetadata(const char* domain) override { return source_.GetMetadata(domain); }
  const char* GetMetadataItem(const char* name, const char* domain) override {
    return source_.GetMetadataItem(name, domain);
  }

 private:
  GDALDataset& source_;
  const OGRSpatialReference* crs_;
};

}  // namespace scree
