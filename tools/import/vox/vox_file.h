// Voxels from MagicaVoxel files. A process of its own reads them (reader_process.h).
#pragma once

#include <set>

#include "tools/import/import_palette.h"
#include "tools/import/placement.h"
#include "tools/import/process/reader_process.h"
#include "tools/import/solid.h"

namespace scree {

struct VoxImport {
  Placement place{};                   ///< z points up in such files, whatever it says
  bool has_scale = false;              ///< else a voxel of the file is one of the world
  float voxel_size_m = 0.25F;          ///< of the world
  MaterialMap map{};                   ///< by a colour's name, or its number from 1 on
  std::optional<Material> material{};  ///< of all others; then no colour becomes a row
  /// Rows that colours become at most, by median cut; nothing: each its own.
  std::optional<size_t> colour_rows_max{};
  ReaderLimits reader{};
};

struct VoxSolid {
  std::unique_ptr<Solid> solid{};
  uint64_t voxels = 0;  ///< of the file
  uint64_t copies = 0;  ///< of its models, that are shown
  uint64_t hidden = 0;  ///< nodes that are not
  double own_volume_m3 = 0.0;
  std::string materials{};           ///< words on what its colours became
  std::set<std::string> map_used{};  ///< keys of the map that shown voxels have
};

/// Each colour that is used becomes a row of `palette`: by `map`, by the name that the file has for it, or a
/// new one that looks so. The error names the file.
Result<VoxSolid> read_vox(const std::string& path, const VoxImport& how, ImportPalette& palette);

}  // namespace scree
