// Bullet's contacts of the last step as impacts: how hard each body was struck, and where.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <vector>

#include "server/bodies/bodies.h"

namespace scree {

/// The strongest contact of each body that changed the body's speed by at least `speed_min_m_s`, by id. A
/// contact's impulse is the sum over its points; its place is their mean, weighted by impulse.
std::vector<BodyImpact> list_impacts(const btDispatcher& dispatcher, const btCollisionObject& terrain,
                                     float speed_min_m_s);

}  // namespace scree
