// Solids from OpenVDB files: level sets, and fog volumes by the density at which rock begins.
#pragma once

#include <set>
#include <string>

#include "tools/import/bricks_import.h"
#include "tools/import/import_palette.h"
#include "tools/import/placement.h"
#include "tools/import/process/reader_process.h"

namespace scree {

struct VdbImport {
  std::string grid{};    ///< its name; by default the one level set, or else the one grid of floats
  double density = 0.5;  ///< of a fog volume: rock where it is more
  Placement place{};
  float voxel_size_m = 0.25F;  ///< of the world
  ReaderLimits reader{};       ///< of the process that reads the file
  /// Gets the rows of the file that it has no row of the same name for; null: the built-in palette's alone.
  ImportPalette* palette = nullptr;
  MaterialMap map{};  ///< names or numbers of materials in the file that stand for rows of it
};

struct VdbSolid {
  std::unique_ptr<Solid> solid;
  std::string grid;
  std::string all_grids{};  ///< of the file, with their types, if there are several
  bool is_level_set = false;
  double own_volume_m3 = 0.0;        ///< of the grid's voxels that are rock
  std::set<std::string> map_used{};  ///< keys of the map that voxels have
  /// What `scree export` wrote of the ground, if the file is from there, its voxels are the world's and it is
  /// not moved: then its codes are exact.
  std::optional<BricksImport::Exact> exact{};
  std::optional<double> level_m{};
  std::optional<MaterialHeights> layers{};
};

/// The error says what is wrong with the file. All of the grid lies in memory from then on.
Result<VdbSolid> read_vdb(const std::string& path, const VdbImport& how);

}  // namespace scree
