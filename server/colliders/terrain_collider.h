// The interface of the terrain colliders: how a body finds the terrain that it touches.
// Lengths in metres, world axes. Not thread-safe, but for TerrainProbe::turn(), list() and terrain_changed().
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "server/colliders/terrain_collider_kind.h"
#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree {

/// A point of a body in or near the ground.
struct TerrainContact {
  int point = 0;             ///< index of the body's point; matches contacts from tick to tick
  glm::vec3 offset_m{0.0F};  ///< from the centre of mass
  glm::vec3 normal{0.0F};    ///< unit, out of the ground
  float distance_m = 0.0F;   ///< to the ground's surface, negative inside
};

/// One body's view of the terrain: a copy of what lies around it.
class TerrainProbe {
 public:
  virtual ~TerrainProbe() = default;

  /// Appends to `out` the points of the body, at `pose`, that are nearer to the ground than `reach_m`:
  /// turn(), copy_terrain() if it is wanted, and list().
  void find(const Pose& pose, float reach_m, std::vector<TerrainContact>& out) {
    if (!turn(pose, reach_m)) copy_terrain();
    list(out);
  }

  /// Turns the points to the pose, and tells whether the copy covers what list() will read; if not,
  /// copy_terrain() comes first. Reads and changes this probe alone: threads may turn different probes at
  /// once.
  virtual bool turn(const Pose& pose, float reach_m) = 0;
  /// Copies the terrain around the pose. Reads the field and what all probes share.
  virtual void copy_terrain() = 0;
  /// Appends the points that are nearer to the ground than the reach. Reads this probe alone, as turn() does.
  virtual void list(std::vector<TerrainContact>& out) const = 0;

  /// Drops the copies of the terrain within this box (voxels). Changes this probe alone, as turn() does.
  virtual void terrain_changed(const VoxelBox& box) = 0;
};

class TerrainCollider {
 public:
  virtual ~TerrainCollider() = default;

  /// Makes the probe of a body whose surface is represented by these points, at least one, relative to its
  /// centre of mass, in its own axes.
  virtual std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) = 0;

  /// Drops the copies of the terrain within this box (voxels) that all probes share. Call it before
  /// TerrainProbe::terrain_changed().
  virtual void terrain_changed(const VoxelBox& box) = 0;
};

/// `field` must outlive the collider, and the collider must outlive its probes.
inline std::unique_ptr<TerrainCollider> make_terrain_collider(TerrainColliderKind kind, const Field& field) {
  return traits_of(kind).make(field);
}

}  // namespace scree
