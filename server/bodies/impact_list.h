// Lists Bullet's contacts of the last step as impacts on bodies: impulse, place and direction.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <map>
#include <vector>

#include "server/bodies/body.h"

namespace scree {

/// How much a push of one newton second at `arm` from the centre of mass, along a unit normal, changes the
/// body's speed there along the normal, by its mass and inertia.
float give_of(const btRigidBody& body, const btVector3& arm, const btVector3& normal);

/// The strongest contact of each body, if it changed the body's speed by at least `speed_min_m_s`, which is
/// positive; ordered by id. `bodies` has all that the dispatcher knows, but for the terrain. A contact's
/// impulse is the sum over its points; its place is their mean, weighted by impulse.
std::vector<BodyImpact> list_impacts(const std::map<PieceId, Body>& bodies, const btDispatcher& dispatcher,
                                     const btCollisionObject& terrain, float speed_min_m_s);

}  // namespace scree
