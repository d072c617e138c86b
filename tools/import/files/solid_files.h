// Solids from files of all kinds: OpenVDB, MagicaVoxel and meshes, by the ends of their names.
#pragma once

#include <set>
#include <string>

#include "tools/import/bricks_import.h"
#include "tools/import/import_palette.h"
#include "tools/import/mesh/sheet.h"
#include "tools/import/placement.h"
#include "tools/import/process/reader_process.h"

namespace scree {

/// Whether a file of that name holds solids, and not heights.
bool is_solid_file(const std::string& path);

struct SolidsImport {
  Placement place{};
  bool has_scale =
      false;           ///< the scale was asked for; else a voxel of a MagicaVoxel file is one of the world
  std::string grid{};  ///< of an OpenVDB file
  double density = 0.5;
  float voxel_size_m = 0.25F;
  SheetRule sheet = SheetRule::refuse;
  std::optional<double> level_m{};  ///< of the rock that sheets are filled down to
  /// What materials are rows of, before those of the files; null: the built-in palette.
  std::shared_ptr<const Palette> palette{};
  MaterialMap material_map{};  ///< names and numbers in files that stand for rows of the palette
  /// Rows that a file adds at most for materials that are none of the palette's; nothing:
  /// limits::mesh_colour_rows for a mesh, and all that there are for voxels.
  std::optional<size_t> colour_rows_max{};
  std::optional<Material> material{};  ///< of rock for which no file says one; then colours make no rows
  ReaderLimits reader{};               ///< of the process that reads each file
};

struct SolidsRead {
  std::vector<std::unique_ptr<Solid>> solids;
  /// What their materials are rows of: what was chosen, and the rows of the files.
  std::shared_ptr<const Palette> palette{};
  /// Sentences on each: what was found, and what was repaired.
  std::vector<std::string> said;
  std::set<std::string> map_used{};  ///< names of the material map that some rock is of
  size_t parts = 0;                  ///< of meshes, without their cavities
  size_t meshes = 0;                 ///< files of meshes
  size_t volumes = 0;                ///< and of volumes
  double volumes_volume_m3 = 0.0;    ///< of these, by their own voxels
  double meshes_volume_m3 = 0.0;     ///< the sum of the meshes' own
  double thin_volume_m3 = 0.0;       ///< of these, in parts that are thinner than a voxel
  double holed_volume_m3 = 0.0;      ///< and in parts with holes
  /// For a single file that was exported from a world (VdbSolid).
  std::optional<BricksImport::Exact> exact{};
  std::optional<double> level_m{};
  std::optional<MaterialHeights> layers{};
};

/// Words on rock that is more or less than the files' own volume, by more than a hundredth.
std::optional<std::string> words_on_difference(const SolidsRead& read, double imported_m3);

/// Less rock than this means that thin meshes were lost.
double least_volume_m3(const SolidsRead& read);

Result<SolidsRead> read_solids(const std::vector<std::string>& files, const SolidsImport& how);

}  // namespace scree
