// The child's part of reading a mesh: assimp opens the file, and its triangles are sent. Internal to
// import/assimp.
#pragma once

#include "tools/import/process/reader_channel.h"

namespace scree {

/// One material of a scene, or none of ours.
inline constexpr uint8_t material_unnamed = 0;

/// What is sent first; then lists of points (double × 3), triangles (uint32_t × 3) and their materials
/// (uint8_t), the names of the materials that are none of ours, and assimp's warnings.
struct SceneHead {
  uint64_t meshes = 0;
  uint64_t foreign_materials = 0;
  uint64_t names = 0;     ///< that are sent, at most scene_names_max
  uint64_t warnings = 0;  ///< at most scene_warnings_max
  double metres_a_unit = 0.0;
  uint8_t says_up = 0;
};

inline constexpr uint64_t scene_names_max = 8;
inline constexpr uint64_t scene_warnings_max = 3;

Result<void> send_scene(ReaderChannel& channel, const std::string& path, const std::string& ending);

}  // namespace scree
