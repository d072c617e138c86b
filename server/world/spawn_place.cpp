#include "server/world/spawn_place.h"

#include <algorithm>
#include <glm/common.hpp>

#include "server/world/overlook.h"
#include "server/world/settings.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// Around an eye there is no rock, at least so far: it neither looks into a wall nor stands in one.
constexpr float free_around_m = 0.8F;
/// An eye is lifted by such steps.
constexpr float lift_step_m = 0.5F;

bool is_rock(const Field& field, glm::vec3 place_m) {
  const glm::vec3 p = place_m / field.source().voxel_size_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
  return field.brick(brick_of(voxel))
             .codes[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))] < 0;
}

bool is_free(const Field& field, glm::vec3 eye_m) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (is_rock(field, eye_m + free_around_m * glm::vec3(x, y, z))) return false;
  return true;
}

}  // namespace

Spawn lifted(const Field& field, const Spawn& wanted) {
  try {
    for (Spawn spawn = wanted; spawn.eye_m.y <= limits::world_half_height_m; spawn.eye_m.y += lift_step_m)
      if (is_free(field, spawn.eye_m)) return spawn;
  } catch (const ChunkUnreadable&) {
    return wanted;  // the next reader of that chunk reports it
  }
  return wanted;
}

std::optional<Spawn> chosen_spawn(const SettingValues& settings) {
  WorldConfig config;
  const auto said = std::ranges::find(settings, spawn_setting, &SettingValue::name);
  if (said == settings.end() || !set(config, *said)) return std::nullopt;
  return config.spawn;
}

Spawn SpawnPlace::find(const Field& field, const std::optional<Spawn>& chosen) {
  if (!chosen && !suggested_) suggested_ = overlook_of(field.source());
  chosen_ = chosen;
  found_ = lifted(field, chosen ? *chosen : *suggested_);
  return *found_;
}

/// Whether the tick changed terrain around the eye, or between the place that was wanted and the eye.
bool SpawnPlace::is_near(const TickDelta& delta, float voxel_size_m) const {
  const float brick_m = static_cast<float>(brick_size) * voxel_size_m;
  const glm::vec3 around_m(free_around_m + voxel_size_m);
  const glm::vec3 lo_m = (chosen_ ? *chosen_ : *suggested_).eye_m - around_m, hi_m = found_->eye_m + around_m;
  const auto touches = [&](BrickCoord brick) {
    const glm::vec3 first_m = glm::vec3(brick.x, brick.y, brick.z) * brick_m;
    return glm::all(glm::lessThan(first_m, hi_m)) && glm::all(glm::greaterThan(first_m + brick_m, lo_m));
  };
  return std::ranges::any_of(delta.bricks, touches, &BrickState::coord) ||
         std::ranges::any_of(delta.reverted, touches);
}

void SpawnPlace::follow(const Field& field, const std::optional<Spawn>& chosen, TickDelta& delta) {
  if (!found_) return;
  if (chosen == chosen_ && !is_near(delta, field.source().voxel_size_m)) return;
  const Spawn before = *found_;
  if (const Spawn now = find(field, chosen); now != before) delta.spawn = now;
}

}  // namespace scree
