// How a body finds the terrain that it touches: the seam behind which the terrain colliders lie.
// Lengths in metres, world axes. Not thread-safe.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree {

/// A point of a body in or near the ground.
struct TerrainContact {
  int point = 0;             ///< which of the body's points: contacts are matched by it from tick to tick
  glm::vec3 offset_m{0.0F};  ///< from the centre of mass
  glm::vec3 normal{0.0F};    ///< unit, out of the ground
  float distance_m = 0.0F;   ///< to the ground's surface, negative inside
};

/// One body's view of the terrain.
class TerrainProbe {
 public:
  virtual ~TerrainProbe() = default;

  /// Appends to `out` the points of the body, lying at `pose`, that are nearer to the ground than `reach_m`.
  virtual void find(const Pose& pose, float reach_m, std::vector<TerrainContact>& out) = 0;

  /// Whatever is remembered of this box (voxels) is stale.
  virtual void terrain_changed(const VoxelBox& box) = 0;
};

class TerrainCollider {
 public:
  virtual ~TerrainCollider() = default;

  /// For a body whose surface is represented by these points, relative to its centre of mass, in its own
  /// axes.
  virtual std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) = 0;
};

/// Tests the points against the field itself: contact normal = gradient. No mesh, so never stale.
std::unique_ptr<TerrainCollider> make_field_collider(Field& field);

}  // namespace scree
