#include "client/viewer/synthesis/hearing.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace scree {
namespace {

/// Nearer, a sound comes from everywhere.
constexpr float beside_m = 0.1F;

}  // namespace

SoundEvent heard(const PieceEvent& event, const Camera& camera) {
  SoundEvent sound{event.kind, event.size_m, event.mass_kg, event.impulse_n_s};
  sound.pitch = event.sound.pitch;
  sound.damping_s = event.sound.damping_s;
  sound.noise = event.sound.noise;
  const glm::vec3 way_m = event.place_m - camera.eye_m;
  sound.distance_m = glm::length(way_m);
  if (sound.distance_m > beside_m)
    sound.side = std::clamp(glm::dot(way_m / sound.distance_m, camera.right()), -1.0F, 1.0F);
  return sound;
}

}  // namespace scree
