#include "server/colliders/terrain_collider.h"

#include "shared/base/check.h"

namespace scree {

std::unique_ptr<TerrainCollider> make_terrain_collider(TerrainColliderKind kind, Field& field) {
  switch (kind) {
    case TerrainColliderKind::field:
      return make_field_collider(field);
    case TerrainColliderKind::mesh:
      return make_mesh_collider(field);
    case TerrainColliderKind::rays:
      return make_rays_collider(field);
  }
  CHECK(false);
}

}  // namespace scree
