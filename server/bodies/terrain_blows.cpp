#include "server/bodies/terrain_blows.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <algorithm>

#include "server/bodies/impact_list.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Contacts lie within this distance beyond a body's reach.
constexpr float beyond_m = 0.25F;

/// The greatest speed that a point of contact of the body had at the step's start.
float greatest_speed_m_s(const Body& body) {
  return body.speed_before.length() + body.spin_before.length() * (body.reach_m + beyond_m);
}

/// The bodies that may take part in a blow of that speed, ordered: those that had half of it, for of two that
/// near each other one has, and what touches them. In a heap nearly all have not.
std::vector<PieceId> that_may_strike(const std::map<PieceId, Body>& bodies, const btDispatcher& dispatcher,
                                     float speed_min_m_s) {
  std::vector<PieceId> fast;
  for (const auto& [id, body] : bodies)
    if (!body.frozen && 2.0F * greatest_speed_m_s(body) >= speed_min_m_s) fast.push_back(id);
  if (fast.empty()) return fast;
  std::vector<PieceId> all = fast;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const PieceId a = id_of(manifold.getBody0()), b = id_of(manifold.getBody1());
    const bool is_a = std::ranges::binary_search(fast, a), is_b = std::ranges::binary_search(fast, b);
    if (is_a != is_b) all.push_back(is_a ? b : a);
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

TerrainBlow blow_of(PieceId id, const Body& body) {
  TerrainBlow blow;
  blow.id = id;
  btVector3 point(0.0F, 0.0F, 0.0F), normal(0.0F, 0.0F, 0.0F);
  for (int i = 0; i < body.ground->getNumContacts(); ++i) {
    const btManifoldPoint& contact = body.ground->getContactPoint(i);
    const float impulse = contact.m_appliedImpulse;
    if (!(impulse > 0.0F)) continue;
    blow.impulse_n_s += impulse;
    point += contact.m_positionWorldOnB * impulse;
    normal += contact.m_normalWorldOnB * impulse;
  }
  if (blow.impulse_n_s <= 0.0F || normal.length2() <= 0.0F) return blow;
  point /= blow.impulse_n_s;
  normal.normalize();
  const btRigidBody& rigid = *body.rigid;
  const btVector3 arm = point - rigid.getWorldTransform().getOrigin();
  const float give = give_of(rigid, arm, normal);
  const float own_m_s = std::max(-body.speed_before_at(arm).dot(normal), 0.0F);
  blow.point_m = from_bullet(point);
  blow.normal = from_bullet(normal);
  blow.speed_m_s = blow.impulse_n_s * give;
  blow.own_n_s = std::min(blow.impulse_n_s, own_m_s / give);
  return blow;
}

std::vector<glm::vec3> points_of(const btPersistentManifold& manifold) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& contact = manifold.getContactPoint(i);
    if (contact.m_appliedImpulse > 0.0F) points.push_back(from_bullet(contact.m_positionWorldOnB));
  }
  return points;
}

/// How fast each body nears another one that strikes it, or that it strikes.
std::map<PieceId, float> nearing_others(const std::map<PieceId, Body>& bodies,
                                        const btDispatcher& dispatcher) {
  std::map<PieceId, float> fastest;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const btRigidBody* first = btRigidBody::upcast(manifold.getBody0());
    const btRigidBody* second = btRigidBody::upcast(manifold.getBody1());
    if (first == nullptr || second == nullptr) continue;
    const auto a = bodies.find(id_of(first)), b = bodies.find(id_of(second));
    if (a == bodies.end() || b == bodies.end() || a->second.rigid.get() != first ||
        b->second.rigid.get() != second)
      continue;                                                          // the terrain's object has no body
    if (a->second.is_kinematic() || b->second.is_kinematic()) continue;  // without a mass, it strikes nothing
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& contact = manifold.getContactPoint(k);
      if (!(contact.m_appliedImpulse > 0.0F)) continue;
      const btVector3 at = contact.m_positionWorldOnB;
      const btVector3 apart = a->second.speed_before_at(at - first->getWorldTransform().getOrigin()) -
                              b->second.speed_before_at(at - second->getWorldTransform().getOrigin());
      const float nears = -apart.dot(contact.m_normalWorldOnB);
      for (const auto& one : {a, b}) {
        float& most = fastest[one->first];
        most = std::max(most, nears);
      }
    }
  }
  return fastest;
}

}  // namespace

std::vector<TerrainBlow> list_terrain_blows(const std::map<PieceId, Body>& bodies,
                                            const btDispatcher& dispatcher, float speed_min_m_s) {
  CHECK(speed_min_m_s > 0.0F);
  std::vector<TerrainBlow> blows;
  for (const PieceId id : that_may_strike(bodies, dispatcher, speed_min_m_s)) {
    const auto found = bodies.find(id);
    if (found == bodies.end()) continue;  // the terrain's object has no body
    const Body& body = found->second;
    if (body.ground == nullptr || body.ground->getNumContacts() == 0 || !body.rigid->isActive()) continue;
    TerrainBlow blow = blow_of(id, body);
    if (blow.speed_m_s < speed_min_m_s) continue;
    blow.points_m = points_of(*body.ground);
    blows.push_back(std::move(blow));
  }
  if (blows.empty()) return blows;
  // A light body between a heavy one and the ground hands on the heavy one's impulse. No contact takes more
  // speed than the bodies had: else there would be more energy than they had.
  const std::map<PieceId, float> others = nearing_others(bodies, dispatcher);
  for (TerrainBlow& blow : blows) {
    const float own_m_s = blow.speed_m_s * blow.own_n_s / blow.impulse_n_s;
    const auto other = others.find(blow.id);
    blow.speed_m_s =
        std::min(blow.speed_m_s, std::max(own_m_s, other == others.end() ? 0.0F : other->second));
  }
  std::erase_if(blows, [&](const TerrainBlow& blow) { return blow.speed_m_s < speed_min_m_s; });
  return blows;
}

void keep_strongest(std::vector<TerrainBlow>& kept, const std::vector<TerrainBlow>& more) {
  for (const TerrainBlow& blow : more) {
    const auto place = std::ranges::lower_bound(kept, blow.id, {}, &TerrainBlow::id);
    if (place == kept.end() || place->id != blow.id)
      kept.insert(place, blow);
    else if (place->energy_j() < blow.energy_j())
      *place = blow;
  }
}

}  // namespace scree
