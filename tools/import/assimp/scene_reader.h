// The child's part of reading a mesh: assimp opens the file, and its triangles are sent. Internal to
// import/assimp.
#pragma once

#include "tools/import/import_palette.h"
#include "tools/import/process/reader_channel.h"

namespace scree {

/// What a triangle is of: 0, nothing that is known; 1 + a row of the palette; from scene_own_first on, a
/// material of the scene that is none of the palette's, in the order in which these are sent.
using SceneMaterial = uint16_t;
inline constexpr SceneMaterial scene_own_first = 256;

struct SceneColour {
  std::array<float, 3> linear{};
  uint8_t is_known = 0;
};

/// What is sent first; then lists of points (double × 3), triangles (uint32_t × 3), their materials and the
/// colours of the materials that are none of ours. Texts follow: the names of these, assimp's warnings, the
/// names of `named` that triangles have, and the file of materials that is not there (or nothing).
struct SceneHead {
  uint64_t meshes = 0;
  uint64_t foreign_materials = 0;  ///< at most limits::scene_materials_max
  uint64_t unread_textures = 0;    ///< pictures of materials that are not there, or are none
  uint64_t warnings = 0;           ///< at most scene_warnings_max
  uint64_t named = 0;              ///< at most as many as there are
  double metres_a_unit = 0.0;
  uint8_t says_up = 0;
};

inline constexpr uint64_t scene_warnings_max = 3;

/// `named`: the names that stand for rows of the palette.
Result<void> send_scene(ReaderChannel& channel, const std::string& path, const std::string& ending,
                        const MaterialMap& named);

}  // namespace scree
