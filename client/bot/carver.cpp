#include "client/bot/carver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/bot/limits.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// Height above the undisturbed ground from which a bot looks down, metres.
constexpr float eye_height_m = 12.0F;

/// Places of stones in a ball of masonry, at most `count`.
std::vector<glm::vec3> masonry(glm::vec3 centre_m, float radius_m, uint32_t count) {
  constexpr float ball = 4.19F;  // volume of radius 1
  const float pitch_m = radius_m * std::cbrt(ball / static_cast<float>(std::max(count, 1U)));
  const int reach = static_cast<int>(radius_m / pitch_m) + 1;
  std::vector<glm::vec3> places;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      for (int z = -reach; z <= reach; ++z) {
        const float aside = y % 2 == 0 ? 0.0F : 0.5F;
        const glm::vec3 off = glm::vec3(static_cast<float>(x) + aside, y, static_cast<float>(z) + aside);
        if (places.size() < count && glm::length(off) * pitch_m <= radius_m)
          places.push_back(centre_m + off * pitch_m);
      }
  return places;
}

bool is_within_square(glm::vec3 place_m, glm::vec3 centre_m, float half_m) {
  constexpr float rounding_m = 0.01F;
  const glm::vec3 off_m = glm::abs(place_m - centre_m);
  return std::max(off_m.x, off_m.z) <= half_m + rounding_m;
}

}  // namespace

Carver::Target Carver::aim_near(Field& field, glm::vec3 centre_m, float half_m) {
  const TerrainSource& terrain = field.source();
  const auto around = [&](float half) { return (random_.unit() * 2.0F - 1.0F) * half; };
  const float x_m = centre_m.x + around(half_m);
  const float z_m = centre_m.z + around(half_m);
  const float ground_m = ground_height_m(terrain, x_m, z_m);
  const glm::vec3 aim_m(x_m, ground_m, z_m);
  // Every second ray is slanted: it finds cliffs, overhangs and arches, which a vertical one would miss.
  glm::vec3 direction(0.0F, -1.0F, 0.0F);
  const glm::vec3 slanted = glm::normalize(glm::vec3(around(1.0F), -0.2F - random_.unit(), around(1.0F)));
  if (random_.below(2) == 1) direction = slanted;
  const float dx = terrain.voxel_size_m;
  for (const glm::vec3 direction_tried : {direction, glm::vec3(0.0F, -1.0F, 0.0F)}) {
    const glm::vec3 eye_m = aim_m + direction_tried * (eye_height_m / direction_tried.y);
    const auto distance = trace(field, eye_m / dx, direction_tried, limits::bot_sight_m / dx);
    const glm::vec3 hit_m = eye_m + direction_tried * (distance.value_or(0.0F) * dx);
    if (distance && is_within_square(hit_m, centre_m, half_m)) return {hit_m, direction_tried};
  }
  return {aim_m, glm::vec3(0.0F, -1.0F, 0.0F)};
}

Shape Carver::shape_at(const Target& target) const {
  return {config_.shape, target.point_m + target.direction * (config_.radius_m * carve_depth_in_radii),
          glm::vec3(0.0F), config_.radius_m};
}

CarveMessage Carver::carve(const Target& target, uint32_t request) {
  CarveMessage carve;
  carve.request = request;
  carve.shape = shape_at(target);
  const SeedPattern in_turn = request % 2 == 0 ? SeedPattern::uniform : SeedPattern::radial;
  carve.pattern = config_.pattern.value_or(in_turn);
  carve.seeds = config_.seeds;
  if (is_given(carve.pattern)) {
    carve.authored_m =
        masonry(carve.shape.a, config_.radius_m, std::min(config_.seeds, limits::authored_seeds_max));
    carve.seeds = static_cast<uint32_t>(carve.authored_m.size());
  }
  carve.random_seed = random_.next();
  carve.impact_m = target.point_m;
  carve.blast_speed_m_s = config_.blast_speed_m_s;
  return carve;
}

}  // namespace scree
