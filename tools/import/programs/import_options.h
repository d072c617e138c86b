// The options of scree-import.
#pragma once

#include <string>
#include <vector>

#include "shared/base/limits.h"
#include "shared/base/option_check.h"
#include "tools/import/files/cover_files.h"
#include "tools/import/files/material_choice.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/heights_import.h"
#include "tools/import/programs/program.h"
#include "tools/import/raster_choice.h"

namespace scree {

/// What the command line says.
struct ImportOptions {
  std::vector<std::string> files;
  std::string out;
  std::string preview;
  std::string on;
  MaterialOptions materials;
  CoverOptions cover;
  std::string sheet = std::string(row_of(SheetRule::refuse).name);
  std::optional<double> level_m;
  std::optional<float> voxel_size_m;
  uint32_t memory_max_mib = 2048;
  double time_max_s = 600.0;
  HeightsImport how;
  RasterChoice raster;
  std::vector<std::string> nodata;
  SolidsImport solids;
  bool has_scale = false;
  std::vector<std::string> given{};  ///< the names of the options that the command line has
};

/// Where the file of an elevation model says it wrong or not at all.
inline void declare_raster(CLI::App& app, ImportOptions& options) {
  RasterChoice& choice = options.raster;
  app.add_option("--band", choice.band, "the band of heights, from 1; default: the first, without alpha")
      ->check(CLI::Range(1, 65536));
  app.add_option(
      "--layer", choice.layer,
      "name or number of a raster in a file that has several (netCDF, HDF), or of a file in an archive");
  app.add_option("--crs", choice.crs, "the map, such as EPSG:32633; default: as the file says");
  app.add_option("--vertical-unit", choice.vertical_unit,
                 "unit of the heights: m, ft, us-ft, cm and others; default: as the file says");
  app.add_option("--nodata", options.nodata,
                 "values that stand for no height, besides the file's own; none: all values are heights")
      ->delimiter(',')
      ->allow_extra_args(false);
}

inline void declare_heights(CLI::App& app, ImportOptions& options) {
  HeightsImport& how = options.how;
  app.add_option("--cell", how.cell_m, "metres between the file's rows; default: as the file says")
      ->check(CLI::PositiveNumber);
  app.add_option("--sample", how.sample_m, "metres between the ground's samples; default: as in the file")
      ->check(CLI::PositiveNumber);
  app.add_option("--vertical-scale", how.vertical_scale, "factor that turns the file's heights into metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--zero", how.zero_m,
                 "height (after the scale) that becomes y = 0, metres; default: the lowest");
  app.add_option("--fill", how.fill_m,
                 "height (after the scale) where the file has none, metres; default: the lowest");
  CoverOptions& cover = options.cover;
  auto* const raster = app.add_option(
      "--cover", cover.raster, "raster of land cover of the same place, whose classes become materials");
  auto* const map = app.add_option("--cover-map", cover.map,
                                   "file with a line NUMBER = material for each class of --cover");
  raster->needs(map);
  map->needs(raster);
  app.add_option("--cover-depth", cover.reach_m, "depth that materials of --cover reach, metres")
      ->needs(raster)
      ->check(CLI::Range(0.01, 50.0))
      ->capture_default_str();
  app.add_option("--preview", options.preview, "draws a shaded relief to this PNG file");
}

inline std::string sheet_rules() {
  std::string all;
  for (const SheetRule rule : all_kinds<SheetRule>)
    all += (all.empty() ? "" : ", ") + std::string(row_of(rule).name) + " " + std::string(row_of(rule).means);
  return all;
}

inline void declare_solids(CLI::App& app, ImportOptions& options) {
  SolidsImport& how = options.solids;
  app.add_option("--on", options.on, "ground file on which solids stand; default: level rock");
  app.add_option(
      "--level", options.level_m,
      "height of the level rock, y in metres; default: a voxel above the lowest point of the solids");
  app.add_option("--at", how.place.at_m, "x,y,z of the files' origin in the world, metres; default: 0,0,0")
      ->delimiter(',');
  app.add_option(
         "--scale", how.place.scale,
         "length of the files' unit, metres; of a .vox, of its voxels, by default as those of the world")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--z-up", how.place.z_up, "says that z points up in the files, not y");
  app.add_option("--voxel-size", options.voxel_size_m,
                 "size of a voxel, metres; default: that of the bricks of --on, or 0.25")
      ->check(CLI::Range(limits::voxel_size_min_m, limits::voxel_size_max_m));
  app.add_option(
      "--grid", how.grid,
      "name of the grid in an OpenVDB file; default: its one level set, or else its one grid of floats");
  app.add_option("--density", how.density, "density of a fog volume above which there is rock")
      ->capture_default_str();
  app.add_option("--sheet", options.sheet, "rule for open sheets, as terrain meshes are: " + sheet_rules())
      ->check(
          CLI::IsMember(std::vector<std::string>(kind_names<SheetRule>.begin(), kind_names<SheetRule>.end())))
      ->capture_default_str();
  app.add_option("--material", options.materials.material,
                 "default material, a row of the palette, where the file names none");
  app.add_option("--material-map", options.materials.map,
                 "file with a line NAME-or-NUMBER = material for each material of the files that is to be a "
                 "row of the palette");
  app.add_option("--palette", how.colour_rows_max,
                 "limit of a file's colours that become rows of the palette, where its materials are none of "
                 "it; more colours share rows; 0: none do; default: 32 of a mesh, all of a .vox")
      ->check(CLI::Range(0, 255));
}

inline void declare(CLI::App& app, ImportOptions& options) {
  app.add_option("file", options.files,
                 "an elevation model (GeoTIFF, ESRI ASCII, 16-bit PNG, or another format of GDAL); or "
                 "solids: OpenVDB (.vdb), MagicaVoxel (.vox) and meshes (.obj, .ply, .stl, .gltf, .glb, "
                 ".off, .dae, .3ds, .fbx)")
      ->required();
  app.add_option("-o,--out", options.out, "the ground file to write")
      ->required()
      ->check(check_replaceable, "FILE");
  app.add_option("--materials", options.materials.palette,
                 "palette (TOML) that materials are rows of; default: that of --on, or the built-in one");
  app.add_option("--soil-below", options.how.soil_below_m,
                 "a metre of soil covers ground below this y, metres; default: all of an elevation model");
  app.add_option("--ice-above", options.how.ice_above_m,
                 "ice covers ground above this y, metres; default: none");
  app.add_option("--memory-max", options.memory_max_mib,
                 "limit of the import's memory, megabytes; a file that needs more is refused")
      ->check(CLI::Range(256, 1 << 20))
      ->capture_default_str();
  app.add_option("--time-max", options.time_max_s,
                 "limit of the time to read a file, and to import solids in all, seconds; what takes longer "
                 "is refused")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  declare_heights(app, options);
  declare_raster(app, options);
  declare_solids(app, options);
}

}  // namespace scree
