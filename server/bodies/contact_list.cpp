#include "server/bodies/contact_list.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <algorithm>

#include "server/bodies/limits.h"

namespace scree {

void list_contacts(const btCollisionDispatcher& dispatcher, std::vector<ContactView>& to) {
  const auto vector_of = [](const btVector3& v) { return glm::vec3(v.x(), v.y(), v.z()); };
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    // Bullet's own accessor of one manifold is const where that of all of them is not.
    const btPersistentManifold& manifold =
        *const_cast<btCollisionDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.getDistance() >= limits::contact_slack_m) continue;
      to.push_back({vector_of(point.getPositionWorldOnB()), vector_of(point.m_normalWorldOnB),
                    std::max(0.0F, static_cast<float>(point.getAppliedImpulse()))});
    }
  }
}

}  // namespace scree
