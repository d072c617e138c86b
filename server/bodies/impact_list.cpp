#include "server/bodies/impact_list.h"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <algorithm>

#include "server/bodies/to_bullet.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

struct ContactBlow {
  float impulse_n_s = 0.0F;
  btVector3 point{0.0F, 0.0F, 0.0F};
  btVector3 normal{0.0F, 0.0F, 0.0F};  ///< towards body 0
};

ContactBlow blow_of(const btPersistentManifold& manifold) {
  ContactBlow blow;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const float impulse = point.m_appliedImpulse;
    if (!(impulse > 0.0F)) continue;
    blow.impulse_n_s += impulse;
    blow.point += point.m_positionWorldOnB * impulse;
    blow.normal += point.m_normalWorldOnB * impulse;
  }
  if (blow.impulse_n_s > 0.0F) blow.point /= blow.impulse_n_s;
  const float length = blow.normal.length();
  blow.normal = length > 0.0F ? blow.normal / length : btVector3(0.0F, 1.0F, 0.0F);
  return blow;
}

/// Null for the terrain.
const btRigidBody* body_of(const btCollisionObject* object) {
  return btRigidBody::upcast(object);
}

bool is_active(const btRigidBody* body) {
  return body != nullptr && body->isActive();
}

}  // namespace

float give_of(const btRigidBody& body, const btVector3& arm, const btVector3& normal) {
  const btVector3 lever = arm.cross(normal);
  return body.getInvMass() + lever.dot(body.getInvInertiaTensorWorld() * lever);
}

std::vector<BodyImpact> list_impacts(const std::map<PieceId, Body>& bodies, const btDispatcher& dispatcher,
                                     const btCollisionObject& terrain, float speed_min_m_s) {
  CHECK(speed_min_m_s > 0.0F);
  std::vector<BodyImpact> impacts;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const btRigidBody* first = body_of(manifold.getBody0());
    const btRigidBody* second = manifold.getBody1() == &terrain ? nullptr : body_of(manifold.getBody1());
    // The solver skips sleeping bodies: their impulses are those of an earlier step.
    if (!is_active(first) && !is_active(second)) continue;
    const ContactBlow blow = blow_of(manifold);
    const auto before = [&](const btRigidBody& body, const btVector3& arm) {
      return bodies.at(id_of(&body)).speed_before_at(arm);
    };
    const auto after = [](const btRigidBody& body, const btVector3& arm) {
      return body.getVelocityInLocalPoint(arm);
    };
    const auto nears_m_s = [&](auto speed) {
      btVector3 apart(0.0F, 0.0F, 0.0F);
      if (first != nullptr) apart += speed(*first, blow.point - first->getCenterOfMassPosition());
      if (second != nullptr) apart -= speed(*second, blow.point - second->getCenterOfMassPosition());
      return std::max(-apart.dot(blow.normal), 0.0F);
    };
    const auto note = [&](const btRigidBody* body, const btRigidBody* other, float sign) {
      if (body == nullptr || blow.impulse_n_s * body->getInvMass() < speed_min_m_s) return;
      const float nears = nears_m_s(before);
      BodyImpact impact{
          id_of(body),
          std::nullopt,
          from_bullet(blow.point),
          from_bullet(blow.normal * sign),
          blow.impulse_n_s,
          blow.impulse_n_s * give_of(*body, blow.point - body->getCenterOfMassPosition(), blow.normal),
          nears,
          0.5F * blow.impulse_n_s * (nears + nears_m_s(after)),
          nears_m_s(after)};
      CHECK_DEBUG(impact.impulse_n_s > 0.0F && is_unit(impact.normal) && is_sound(impact.point_m));
      if (other != nullptr) impact.other = id_of(other);
      impacts.push_back(impact);
    };
    note(first, second, 1.0F);
    note(second, first, -1.0F);
  }
  // The strongest of several contacts of one body comes first, and only the first stays. Stable: the
  // dispatcher's order is the same in any build.
  std::ranges::stable_sort(impacts, [](const BodyImpact& a, const BodyImpact& b) {
    return a.id != b.id ? a.id < b.id : a.impulse_n_s > b.impulse_n_s;
  });
  const auto same_body = [](const BodyImpact& a, const BodyImpact& b) { return a.id == b.id; };
  impacts.erase(std::unique(impacts.begin(), impacts.end(), same_body), impacts.end());
  return impacts;
}

}  // namespace scree
