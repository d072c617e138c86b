// How a body finds the terrain that it touches: the seam behind which the terrain colliders lie.
// Lengths in metres, world axes. Not thread-safe.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "server/bodies/terrain_collider_kind.h"
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

  /// Whatever all bodies share of this box (voxels) is stale. Comes before that of the probes.
  virtual void terrain_changed(const VoxelBox& box) = 0;
};

/// `field` must outlive the collider, and that its probes.
std::unique_ptr<TerrainCollider> make_terrain_collider(TerrainColliderKind kind, Field& field);

/// Tests the points against the field itself: contact normal = gradient. No mesh, so never stale.
std::unique_ptr<TerrainCollider> make_field_collider(Field& field);

/// Tests the points against the triangles that are drawn (server/bodies/terrain_mesh.h), blocks of them made
/// anew when the terrain changes: the paper's way with its grid ("Raymarching": the polygons are what the
/// physics collides with). A point sees the nearest triangle; what has got more than
/// limits::mesh_depth_voxels behind it falls.
std::unique_ptr<TerrainCollider> make_mesh_collider(Field& field);

/// The paper's way without polygons (the same section): each body, in each tick, casts a few sparse rays from
/// its own position down onto the terrain, and takes what lies between them to be even. Walls and overhangs
/// are seen by chance.
std::unique_ptr<TerrainCollider> make_rays_collider(Field& field);

}  // namespace scree
