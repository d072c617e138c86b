#include "client/render/scene/contact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "client/render/scene/limits.h"
#include "shared/field/mass.h"

namespace scree {

std::vector<Contact> contacts_of(const ScenePieces& pieces, float voxel_m, glm::vec3 eye_m) {
  constexpr float sphere_volume = 4.1887902F;  // of radius 1
  std::vector<Contact> contacts;
  contacts.reserve(pieces.size());
  for (const auto& [id, piece] : pieces) {
    const float voxels = static_cast<float>(piece.volume->mass) / static_cast<float>(units_per_voxel);
    contacts.push_back({piece.pose.position_m, voxel_m * std::cbrt(std::max(voxels, 0.0F) / sphere_volume)});
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
