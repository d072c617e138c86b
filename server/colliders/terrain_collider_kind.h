// The ways in which bodies find the terrain, each a row of one table and a file of its own; the interface is
// terrain_collider.h.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

class Field;
class TerrainCollider;

/// `field` must outlive the collider.
using MakeTerrainCollider = std::unique_ptr<TerrainCollider>(const Field& field);

/// Tests the points against the field itself: the contact's normal is the field's gradient. Depths reach 3
/// voxels, where codes saturate.
MakeTerrainCollider make_field_collider;

/// Tests the points against the triangles that are drawn (server/colliders/terrain_mesh.h); a block of them
/// is made again when its terrain changes. The paper's grid does this ("Raymarching": the physics collides
/// with the polygons). A point collides with the nearest triangle, unless it lies more than
/// limits::mesh_depth_voxels behind it: then it falls.
MakeTerrainCollider make_mesh_collider;

/// The paper's method without polygons (same section): each body casts a few rays down onto the terrain in
/// each tick, and the ground between rays is interpolated. Walls and overhangs are missed unless a ray meets
/// them.
MakeTerrainCollider make_rays_collider;

enum class TerrainColliderKind : uint8_t { field, mesh, rays };

struct TerrainColliderRow {
  std::string_view name;
  MakeTerrainCollider* make = nullptr;
};

constexpr TerrainColliderRow row_of(TerrainColliderKind kind) {
  switch (kind) {
    case TerrainColliderKind::field:
      return {.name = "field", .make = make_field_collider};
    case TerrainColliderKind::mesh:
      return {.name = "mesh", .make = make_mesh_collider};
    case TerrainColliderKind::rays:
      return {.name = "rays", .make = make_rays_collider};
  }
  return {};
}

}  // namespace scree
