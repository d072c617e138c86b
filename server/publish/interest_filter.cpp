#include "server/publish/interest_filter.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "proto/limits.h"

namespace scree {

std::vector<PlayerCursor> cursors_for(uint64_t session, const std::map<uint64_t, PartyCursor>& cursors,
                                      glm::vec3 eye_m, float radius_m) {
  struct Near {
    size_t turn = 0;
    float distance_m = 0.0F;
    const PartyCursor* of = nullptr;
  };
  std::vector<Near> near;
  for (const auto& [other, one] : cursors) {
    const float distance_m =
        std::min(glm::distance(one.cursor.eye_m, eye_m), glm::distance(one.cursor.aim_m, eye_m));
    if (other != session && distance_m <= radius_m) near.push_back({0, distance_m, &one});
  }
  const auto session_of = [](const Near& one) { return one.of->cursor.session; };
  if (near.size() > limits::cursors_max) {
    std::ranges::stable_sort(near, {}, &Near::distance_m);
    std::map<uint64_t, size_t> turns;
    for (Near& one : near) one.turn = turns[one.of->party]++;
    std::ranges::stable_sort(near, {}, &Near::turn);
    near.resize(limits::cursors_max);
    std::ranges::sort(near, {}, session_of);
  }
  std::vector<PlayerCursor> seen;
  for (const Near& one : near) seen.push_back(one.of->cursor);
  return seen;
}

PhysicsMessage physics_for(const PhysicsMessage& physics, const PublishedState& state, float voxel_size_m,
                           glm::vec3 eye_m, float radius_m) {
  const auto near = [&](glm::vec3 place_m) { return glm::distance(place_m, eye_m) <= radius_m; };
  PhysicsMessage part;
  part.tick = physics.tick;
  for (const BodyView& body : physics.bodies) {
    const auto piece = state.pieces().find(body.id);
    const auto prop = state.props().find(body.id);
    const bool is_piece = piece != state.pieces().end();
    if (!is_piece && prop == state.props().end()) continue;
    if (!near(dequantise(is_piece ? piece->second.pose : prop->second.pose).position_m)) continue;
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
