#include "server/bodies/terrain_manifold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/limits.h"
#include "server/bodies/to_bullet.h"
#include "server/bodies/told_overlap.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Distance to the ground at the tick's end if nothing stopped the body.
float expected_distance_m(const TerrainContact& contact, glm::vec3 velocity, glm::vec3 spin, float step_s) {
  const glm::vec3 moving = velocity + glm::cross(spin, contact.offset_m);
  return contact.distance_m + glm::dot(moving, contact.normal) * step_s;
}

/// Moves the wanted contacts to the front and returns their number: first the deepest, then again and again
/// the one farthest from those chosen, so that they carry the body like a tripod. `found` must not be empty.
size_t choose(std::vector<TerrainContact>& found) {
  CHECK_DEBUG(!found.empty());
  std::ranges::iter_swap(found.begin(), std::ranges::min_element(found, {}, &TerrainContact::distance_m));
  const size_t wanted = std::min<size_t>(found.size(), MANIFOLD_CACHE_SIZE);
  for (size_t chosen = 1; chosen < wanted; ++chosen) {
    size_t best = chosen;
    float best_gap = -1.0F;
    for (size_t i = chosen; i < found.size(); ++i) {
      float gap = 1e30F;
      for (size_t j = 0; j < chosen; ++j) {
        const glm::vec3 off = found[i].offset_m - found[j].offset_m;
        gap = std::min(gap, glm::dot(off, off));
      }
      if (gap > best_gap) best_gap = gap, best = i;
    }
    std::swap(found[chosen], found[best]);
  }
  return wanted;
}

/// Half a voxel below the deepest contact.
glm::vec3 place_below(const btRigidBody& body, const TerrainContact& deepest, float voxel_size_m) {
  const glm::vec3 on_body_m = from_bullet(body.getWorldTransform().getOrigin()) + deepest.offset_m;
  const float down_m = deepest.distance_m + 0.5F * voxel_size_m;
  return on_body_m - deepest.normal * down_m;
}

btManifoldPoint contact_point(const TerrainContact& contact, const btRigidBody& body,
                              const TerrainSurface& surface) {
  const btTransform& at = body.getWorldTransform();
  const bool buried = contact.distance_m < -limits::overlap_shallow_m;
  const float undo_m_s = buried ? limits::undo_buried_m_s : limits::undo_shallow_m_s;
  const float distance = std::max(contact.distance_m, -told_overlap_m(undo_m_s, surface.step_s));
  const btVector3 on_body = at.getOrigin() + to_bullet(contact.offset_m);
  const btVector3 normal = to_bullet(contact.normal);
  const btVector3 on_ground = on_body - normal * distance;
  btManifoldPoint point(at.invXform(on_body), on_ground, normal, distance);
  point.m_positionWorldOnA = on_body;
  point.m_positionWorldOnB = on_ground;
  point.m_index0 = contact.point;
  return point;
}

}  // namespace

glm::vec3 refill(btPersistentManifold& manifold, const btRigidBody& body, std::vector<TerrainContact>& found,
                 const TerrainSurface& surface) {
  CHECK_DEBUG(manifold.getBody0() == &body);
  std::array<btManifoldPoint, MANIFOLD_CACHE_SIZE> old;
  const int old_count = manifold.getNumContacts();
  for (int i = 0; i < old_count; ++i) old[static_cast<size_t>(i)] = manifold.getContactPoint(i);
  manifold.clearManifold();

  const glm::vec3 velocity = from_bullet(body.getLinearVelocity());
  const glm::vec3 spin = from_bullet(body.getAngularVelocity());
  std::erase_if(found, [&](const TerrainContact& contact) {
    return expected_distance_m(contact, velocity, spin, surface.step_s) > limits::contact_slack_m;
  });
  if (found.empty()) return glm::vec3(0.0F);
  const size_t wanted = choose(found);
  for (size_t i = 0; i < wanted; ++i) {
    btManifoldPoint point = contact_point(found[i], body, surface);
    for (int j = 0; j < old_count; ++j) {
      const btManifoldPoint& before = old[static_cast<size_t>(j)];
      if (before.m_index0 != point.m_index0) continue;
      point.m_appliedImpulse = before.m_appliedImpulse;
      point.m_appliedImpulseLateral1 = before.m_appliedImpulseLateral1;
      point.m_appliedImpulseLateral2 = before.m_appliedImpulseLateral2;
      point.m_prevRHS = before.m_prevRHS;
      point.m_lifeTime = before.m_lifeTime + 1;
    }
    manifold.addManifoldPoint(point);
  }
  CHECK_DEBUG(static_cast<size_t>(manifold.getNumContacts()) == wanted);
  return place_below(body, found.front(), surface.voxel_size_m);
}

void roughen(btPersistentManifold& manifold, const btRigidBody& body, const MaterialRow& terrain) {
  // The body's own are square roots already: Bullet multiplies the two.
  const float friction = body.getFriction() * std::sqrt(terrain.friction);
  const float restitution = body.getRestitution() * std::sqrt(terrain.restitution);
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    manifold.getContactPoint(i).m_combinedFriction = friction;
    manifold.getContactPoint(i).m_combinedRestitution = restitution;
  }
}

}  // namespace scree
