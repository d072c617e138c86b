#include "client/bot/carver.h"

#include <glm/geometric.hpp>

#include "client/bot/limits.h"

namespace scree {

namespace {

/// Height above the undisturbed ground from which a bot looks down, metres.
constexpr float eye_height_m = 12.0F;

}  // namespace

Carver::Hit Carver::look(Field& field) {
  const TerrainSource& terrain = field.source();
  const auto around = [&](float half) { return (random_.unit() * 2.0F - 1.0F) * half; };
  const float x_m = config_.centre_m.x + around(config_.area_m);
  const float z_m = config_.centre_m.z + around(config_.area_m);
  const float ground_m = ground_height_m(terrain, x_m, z_m);
  const glm::vec3 eye_m(x_m, ground_m + eye_height_m, z_m);
  // Every second look is slanted: it finds cliffs, overhangs and arches, which none from above would.
  glm::vec3 direction(0.0F, -1.0F, 0.0F);
  const glm::vec3 slanted = glm::normalize(glm::vec3(around(1.0F), -0.2F - random_.unit(), around(1.0F)));
  if (random_.below(2) == 1) direction = slanted;
  const float dx = terrain.voxel_size_m;
  for (const glm::vec3 look : {direction, glm::vec3(0.0F, -1.0F, 0.0F)}) {
    const auto distance = trace(field, eye_m / dx, look, limits::bot_sight_m / dx);
    if (distance) return {eye_m + look * (*distance * dx), look};
  }
  return {glm::vec3(x_m, ground_m, z_m), glm::vec3(0.0F, -1.0F, 0.0F)};
}

CarveMessage Carver::next(Field& field, uint32_t request) {
  const Hit hit = look(field);
  CarveMessage carve;
  carve.request = request;
  carve.shape =
      sphere(hit.point_m + hit.direction * (config_.radius_m * carve_depth_in_radii), config_.radius_m);
  const SeedPattern in_turn = request % 2 == 0 ? SeedPattern::uniform : SeedPattern::radial;
  carve.pattern = config_.pattern.value_or(in_turn);
  carve.seeds = config_.seeds;
  carve.random_seed = random_.next();
  carve.impact_m = hit.point_m;
  carve.blast_speed_m_s = config_.blast_speed_m_s;
  return carve;
}

}  // namespace scree
