#include "client/render/scene/contact.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "client/render/scene/limits.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

constexpr float sphere_volume = 4.1887902F;  // of radius 1

float radius_of(float volume) {
  return std::cbrt(std::max(volume, 0.0F) / sphere_volume);
}

/// Half of the box about a hull's corners, and its middle. A hull fills about half of the box.
Contact ball_of_hull(const std::vector<glm::vec3>& corners_m) {
  glm::vec3 lo = corners_m.front(), hi = lo;
  for (const glm::vec3& corner_m : corners_m) {
    lo = glm::min(lo, corner_m);
    hi = glm::max(hi, corner_m);
  }
  const glm::vec3 side = hi - lo;
  return {0.5F * (lo + hi), radius_of(0.5F * side.x * side.y * side.z)};
}

/// In the part's axes.
Contact ball_of(const PropPart& part) {
  const glm::vec3 half = part.half_m;
  const float tube = 6.2831853F * half.x * half.x * half.y;
  const float ball = sphere_volume * half.x * half.x * half.x;
  switch (part.kind) {
    case PropPartKind::box:
      return {{}, radius_of(8.0F * half.x * half.y * half.z)};
    case PropPartKind::sphere:
      return {{}, half.x};
    case PropPartKind::capsule:
      return {{}, radius_of(tube + ball)};
    case PropPartKind::cylinder:
      return {{}, radius_of(tube)};
    case PropPartKind::hull:
      return ball_of_hull(part.corners_m);
  }
  return {};
}

}  // namespace

std::vector<Contact> contacts_of(const Scene& scene, glm::vec3 eye_m) {
  const float voxel_m = scene.field.source().voxel_size_m;
  std::vector<Contact> contacts;
  contacts.reserve(scene.pieces.size() + scene.props.size());
  for (const auto& [id, piece] : scene.pieces) {
    const float voxels = static_cast<float>(piece.volume->mass) / static_cast<float>(units_per_voxel);
    contacts.push_back({piece.pose.position_m, voxel_m * radius_of(voxels)});
  }
  for (const auto& [id, shown] : scene.props)
    for (const PropPart& part : shown.prop->parts) {
      const Contact ball = ball_of(part);
      const glm::vec3 in_prop = part.place_m + part.turn * ball.centre_m;
      contacts.push_back({shown.pose.position_m + shown.pose.rotation * in_prop, ball.radius_m});
    }
  if (contacts.size() > limits::contacts_max) {
    const auto nearest = contacts.begin() + limits::contacts_max;
    std::ranges::nth_element(contacts, nearest, {}, [eye_m](const Contact& contact) {
      return glm::distance(contact.centre_m, eye_m);
    });
    contacts.erase(nearest, contacts.end());
  }
  return contacts;
}

}  // namespace scree
