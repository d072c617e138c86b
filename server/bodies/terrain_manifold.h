// Hands terrain contacts to Bullet's solver and island manager: one manifold per body, against one static
// object that is in no broadphase, refilled before each step.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <vector>

#include "server/colliders/terrain_collider.h"

namespace scree {

/// Parameters that all terrain contacts of a step share. Friction comes from the field's material.
struct TerrainSurface {
  const Field& field;
  float restitution = 0.0F;
  float step_s = 0.0F;
};

/// Refills `manifold`, whose body 0 is `body`, with those of `found` that may touch within the tick: at most
/// four, spread wide. A point that was in the manifold before keeps its impulses (warm starting). Changes
/// the order and content of `found`.
void refill(btPersistentManifold& manifold, const btRigidBody& body, std::vector<TerrainContact>& found,
            const TerrainSurface& surface);

}  // namespace scree
