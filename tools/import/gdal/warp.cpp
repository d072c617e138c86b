#include "tools/import/gdal/warp.h"

#include <cpl_error.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdalwarper.h>
#include <limits>

#include "tools/import/gdal/gdal_library.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// A place may be off by that part of a cell, so that not every cell is transformed by itself.
constexpr double error_cells_max = 0.02;

struct DestroyTransformer {
  void operator()(void* transformer) const { GDALDestroyTransformer(transformer); }
};
using Transformer = std::unique_ptr<void, DestroyTransformer>;

struct DestroyOptions {
  void operator()(GDALWarpOptions* options) const { GDALDestroyWarpOptions(options); }
};

void set_map(CPLStringList& options, const char* name, const OGRSpatialReference* map) {
  if (map == nullptr) return;
  char* text = nullptr;
  const char* const form[] = {"FORMAT=WKT2_2018", nullptr};
  map->exportToWkt(&text, form);
  options.SetNameValue(name, text);
  CPLFree(text);
}

Result<Transformer> transformer_of(GDALDataset& source, const OGRSpatialReference* from,
                                   const OGRSpatialReference* map, const char* method) {
  CPLStringList options;
  options.SetNameValue("METHOD", method);
  set_map(options, "SRC_SRS", from);
  set_map(options, "DST_SRS", map);
  Transformer transformer(
      GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(&source), nullptr, options.List()));
  if (!transformer)
    return fail("its place on the map cannot be computed: " + gdal_words("GDAL says no reason"));
  return transformer;
}

/// GDAL has the transformer then, also where it fails: who destroys it there differs by the place.
Result<Dataset> warped(GDALDataset& source, Transformer transformer, GDALTransformerFunc transform,
                       const WarpGrid& grid, GDALResampleAlg resampling) {
  if (grid.columns > limits::raster_side_max || grid.rows > limits::raster_side_max)
    return fail(
        fmt::format("with north up it has {} × {} cells: at most {} a side can be imported "
                    "(limits.raster_side_max)",
                    grid.columns, grid.rows, limits::raster_side_max));
  const std::unique_ptr<GDALWarpOptions, DestroyOptions> options(GDALCreateWarpOptions());
  options->hSrcDS = GDALDataset::ToHandle(&source);
  options->eResampleAlg = resampling;
  options->eWorkingDataType = GDT_Float64;
  options->pfnTransformer = transform;
  options->pTransformerArg = transformer.release();
  GDALWarpInitDefaultBandMapping(options.get(), 1);
  GDALWarpInitSrcNoDataReal(options.get(), std::numeric_limits<double>::quiet_NaN());
  GDALWarpInitDstNoDataReal(options.get(), std::numeric_limits<double>::quiet_NaN());
  options->papszWarpOptions = CSLSetNameValue(options->papszWarpOptions, "INIT_DEST", "NO_DATA");
  std::array<double, 6> transform_of_grid = grid.transform.t;
  Dataset made(GDALDataset::FromHandle(GDALCreateWarpedVRT(options->hSrcDS, grid.columns, grid.rows,
                                                           transform_of_grid.data(), options.get())));
  if (!made) return fail("it cannot be put with north up: " + gdal_words("GDAL says no reason"));
  return made;
}

}  // namespace

Result<Dataset> warp_to_grid(GDALDataset& source, const WarpGrid& grid, bool exact) {
  Transformer transformer = TRY(transformer_of(source, nullptr, nullptr, "GEOTRANSFORM"));
  GDALSetGenImgProjTransformerDstGeoTransform(transformer.get(), grid.transform.t.data());
  return warped(source, std::move(transformer), GDALGenImgProjTransform, grid,
                exact ? GRA_NearestNeighbour : GRA_Bilinear);
}

Result<Dataset> warp_to_map(GDALDataset& source, const OGRSpatialReference* from,
                            const OGRSpatialReference* map, const char* method) {
  Transformer inner = TRY(transformer_of(source, from, map, method));
  WarpGrid grid;
  std::array<double, 4> extent{};
  if (GDALSuggestedWarpOutput2(GDALDataset::ToHandle(&source), GDALGenImgProjTransform, inner.get(),
                               grid.transform.t.data(), &grid.columns, &grid.rows, extent.data(),
                               0) != CE_None)
    return fail("its place on the map cannot be computed: " + gdal_words("GDAL says no reason"));
  GDALSetGenImgProjTransformerDstGeoTransform(inner.get(), grid.transform.t.data());
  Transformer outer(GDALCreateApproxTransformer(GDALGenImgProjTransform, inner.get(), error_cells_max));
  if (!outer) return fail("it cannot be put with north up: " + gdal_words("GDAL says no reason"));
  GDALApproxTransformerOwnsSubtransformer(outer.get(), TRUE);
  static_cast<void>(inner.release());
  return warped(source, std::move(outer), GDALApproxTransform, grid, GRA_Bilinear);
}

Result<std::array<double, 2>> middle_on_map(GDALDataset& source, const char* method) {
  const Transformer transformer = TRY(transformer_of(source, nullptr, nullptr, method));
  double x = 0.5 * source.GetRasterXSize(), y = 0.5 * source.GetRasterYSize(), z = 0.0;
  int done = 0;
  if (GDALGenImgProjTransform(transformer.get(), FALSE, 1, &x, &y, &z, &done) == 0 || done == 0)
    return fail("its middle lies nowhere on the map: " + gdal_words("GDAL says no reason"));
  return std::array{x, y};
}

}  // namespace scree
