#include "server/publish/interest_filter.h"

#include <glm/geometric.hpp>

#include "proto/limits.h"

namespace scree {

std::vector<PlayerCursor> cursors_for(uint64_t session, const std::map<uint64_t, PlayerCursor>& cursors,
                                      glm::vec3 eye_m, float radius_m) {
  std::vector<PlayerCursor> near;
  for (const auto& [other, cursor] : cursors) {
    const bool seen =
        glm::distance(cursor.eye_m, eye_m) <= radius_m || glm::distance(cursor.aim_m, eye_m) <= radius_m;
    if (other != session && seen && near.size() < limits::cursors_max) near.push_back(cursor);
  }
  return near;
}

PhysicsMessage physics_for(const PhysicsMessage& physics, const PublishedState& state, float voxel_size_m,
                           glm::vec3 eye_m, float radius_m) {
  const auto near = [&](glm::vec3 place_m) { return glm::distance(place_m, eye_m) <= radius_m; };
  PhysicsMessage part;
  part.tick = physics.tick;
  for (const BodyView& body : physics.bodies) {
    const auto piece = state.pieces().find(body.id);
    if (piece == state.pieces().end() || !near(dequantise(piece->second.pose).position_m)) continue;
    if (part.bodies.size() < limits::physics_bodies_max) part.bodies.push_back(body);
  }
  for (const ContactView& contact : physics.contacts)
    if (near(contact.point_m) && part.contacts.size() < limits::physics_contacts_max)
      part.contacts.push_back(contact);
  for (const BrickCoord brick : physics.searched) {
    const glm::vec3 place_m = glm::vec3(brick.x, brick.y, brick.z) * (brick_size * voxel_size_m);
    if (near(place_m) && part.searched.size() < limits::physics_bricks_max) part.searched.push_back(brick);
  }
  return part;
}

}  // namespace scree
