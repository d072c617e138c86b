// Hands terrain contacts to Bullet's solver: one manifold per body, against one static
// object that is in no broadphase, refilled before each step.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <vector>

#include "server/colliders/terrain_collider.h"
#include "shared/material/palette.h"

namespace scree {

/// Parameters that all terrain contacts of a step share.
struct TerrainSurface {
  float voxel_size_m = 0.0F;
  float step_s = 0.0F;
};

/// Refills `manifold`, whose body 0 is `body`, with those of `found` that may touch within the tick: at most
/// four, spread wide. A point that was in the manifold before keeps its impulses (warm starting). Returns the
/// place, metres, whose material the body rubs on, for roughen(); of no use when there are no contacts.
/// Changes the order and content of `found`.
glm::vec3 refill(btPersistentManifold& manifold, const btRigidBody& body, std::vector<TerrainContact>& found,
                 const TerrainSurface& surface);
/// Sets friction and restitution of all contacts, between the body and that material of the terrain.
void roughen(btPersistentManifold& manifold, const btRigidBody& body, const MaterialRow& terrain);

}  // namespace scree
