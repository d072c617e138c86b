// The terrain as a NanoVDB grid of floats, and rays through it by NanoVDB's own HDDA. Voxels unless a name
// says otherwise. A grid never changes: after a carve it is made anew.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/field/field.h"

namespace scree::peers {

class NanoTerrain {
 public:
  /// Copies the field's distances in that box into a level set, and converts it.
  NanoTerrain(const Field& field, const VoxelBox& box);
  ~NanoTerrain();
  NanoTerrain(const NanoTerrain&) = delete;
  NanoTerrain& operator=(const NanoTerrain&) = delete;

  /// Time that NanoVDB's conversion took, without the copying; it uses every core.
  double convert_ms() const;
  /// The grid, as shaders read it.
  std::span<const uint32_t> words() const;

  static constexpr float none = std::numeric_limits<float>::infinity();
  /// Distances along rays from one point in directions of unit length, up to the surface; `none` where they
  /// meet none in the box. By ZeroCrossing() with one accessor: exact to the voxel. On this thread.
  void trace(glm::vec3 from, std::span<const glm::vec3> directions, std::span<float> along) const;

  /// "32.4.2"
  static std::string version();

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace scree::peers
