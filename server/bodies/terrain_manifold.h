// Terrain contacts as Bullet's solver and island manager see them: one manifold per body, against one static
// object that is in no broadphase, refilled before each step.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <vector>

#include "server/bodies/terrain_collider.h"

namespace scree {

/// What every terrain contact of a tick has in common. Friction is that of the material under the body.
struct TerrainSurface {
  const Field& field;
  float restitution = 0.0F;
  float tick_s = 0.0F;
};

/// Body 0 of `manifold` is `body`. Takes those of `found` that may touch within the tick, at most four,
/// spread wide, and hands on the impulses that the same points bore in the last step (warm starting).
/// Clobbers `found`.
void refill(btPersistentManifold& manifold, const btRigidBody& body, std::vector<TerrainContact>& found,
            const TerrainSurface& surface);

}  // namespace scree
