// Solids from files of all kinds: OpenVDB and meshes, by the ends of their names.
#pragma once

#include <string>

#include "tools/import/bricks_import.h"
#include "tools/import/placement.h"
#include "tools/import/process/reader_process.h"

namespace scree {

/// Whether a file of that name holds solids, and not heights.
bool is_solid_file(const std::string& path);

struct SolidsImport {
  Placement place{};
  std::string grid{};  ///< of an OpenVDB file
  double density = 0.5;
  float voxel_size_m = 0.25F;
  ReaderLimits reader{};  ///< of the process that reads each file
};

struct SolidsRead {
  std::vector<std::unique_ptr<Solid>> solids;
  /// Sentences on each: what was found, and what was repaired.
  std::vector<std::string> said;
  double meshes_volume_m3 = 0.0;  ///< the sum of the meshes' own
  /// For a single file that was exported from a world (VdbSolid).
  std::optional<BricksImport::Exact> exact{};
  std::optional<double> level_m{};
  std::optional<MaterialHeights> layers{};
};

Result<SolidsRead> read_solids(const std::vector<std::string>& files, const SolidsImport& how);

}  // namespace scree
