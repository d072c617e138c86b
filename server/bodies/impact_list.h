// Lists Bullet's contacts of the last step as impacts on bodies: impulse, place and direction.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <vector>

#include "server/bodies/bodies.h"

namespace scree {

/// The strongest contact of each body, if it changed the body's speed by at least `speed_min_m_s`, which is
/// positive; ordered by id. A contact's impulse is the sum over its points; its place is their mean, weighted
/// by impulse.
std::vector<BodyImpact> list_impacts(const btDispatcher& dispatcher, const btCollisionObject& terrain,
                                     float speed_min_m_s);

}  // namespace scree
