#include "shared/person/walker.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/base/limits.h"
#include "shared/base/walking.h"

namespace scree {
namespace {

constexpr float tick_s = 1.0F / 120.0F;
constexpr float frame_max_s = 0.5F;  ///< a longer one is shortened: after a stall, nobody has walked on
constexpr float fall_m_s2 = 9.81F;
constexpr float walk_m_s = 4.0F;
constexpr float run_m_s = 7.5F;
constexpr float jump_m_s = 4.8F;  ///< 1.2 m high
constexpr float fall_max_m_s = 40.0F;
constexpr float grip_m_s2 = 45.0F;  ///< how fast the speed changes on the ground, and in the air
constexpr float air_grip_m_s2 = 9.0F;
/// Moved at once at most: a third of the radius, so that no wall is jumped over.
constexpr float move_max_m = 0.1F;
constexpr int settle_rounds = 8;
constexpr int wedged_ticks = 18;

/// Centres of the body's spheres, above the feet.
constexpr int spheres = 5;
glm::vec3 sphere_m(glm::vec3 feet_m, int i) {
  constexpr float apart_m = (Walker::height_m - 2.0F * Walker::radius_m) / (spheres - 1);
  return feet_m + glm::vec3(0.0F, Walker::radius_m + apart_m * static_cast<float>(i), 0.0F);
}

glm::vec3 level(glm::vec3 v) {
  return {v.x, 0.0F, v.z};
}

constexpr glm::vec3 up(0.0F, 1.0F, 0.0F);

/// The number is not negative, and small.
int ceil_to_int(float number) {
  const int whole = static_cast<int>(number);
  return static_cast<float>(whole) < number ? whole + 1 : whole;
}

struct Push {
  float depth_m = 0.0F;  ///< over 0: so far into it
  glm::vec3 away{0.0F};
};

/// The deepest contact of a body there.
template <typename Touch>
Push deepest(glm::vec3 feet_m, Touch touch) {
  Push push{-1.0F, up};
  for (int i = 0; i < spheres; ++i) {
    const WalkGround::Touch near = touch(sphere_m(feet_m, i));
    const float depth_m = Walker::radius_m - near.distance_m;
    if (depth_m > push.depth_m) push = {depth_m, near.away == glm::vec3(0.0F) ? up : near.away};
  }
  return push;
}

/// Out of it: ground that carries pushes straight up, so that nobody slides; a wall to the side, so that
/// nobody climbs.
glm::vec3 push_out_m(const Push& push) {
  const float upward = push.away.y;
  if (upward >= Walker::slope_cosine) return up * (push.depth_m / upward);
  const float sideward = glm::length(level(push.away));
  if (upward >= 0.0F && sideward > 0.0F) return level(push.away) * (push.depth_m / (sideward * sideward));
  return push.away * push.depth_m;
}

}  // namespace

float Walker::depth_m(glm::vec3 feet_m, WalkGround& ground) {
  return deepest(feet_m, [&](glm::vec3 place_m) { return ground.rock(place_m); }).depth_m;
}

bool Walker::is_free(glm::vec3 feet_m, WalkGround& ground) {
  return depth_m(feet_m, ground) <= skin_m;
}

Walker::Settled Walker::settle(glm::vec3 feet_m, WalkGround& ground) {
  Settled settled{feet_m, false, std::nullopt};
  const auto push_out = [&](const Push& push) {
    if (push.depth_m <= 0.0F) return false;
    settled.feet_m += push_out_m(push);
    if (push.away.y >= slope_cosine) {
      settled.carried = true;
    } else {
      settled.wall = push.away;
    }
    return true;
  };
  for (int round = 0; round < settle_rounds; ++round) {
    // Pieces at first only, so that rock has the last word.
    const bool pushed =
        round < settle_rounds / 2 &&
        push_out(deepest(settled.feet_m, [&](glm::vec3 place_m) { return ground.loose(place_m); }));
    const bool rock =
        push_out(deepest(settled.feet_m, [&](glm::vec3 place_m) { return ground.rock(place_m); }));
    if (!pushed && !rock) break;
  }
  return settled;
}

void Walker::step(const WalkInput& input, float elapsed_s, WalkGround& ground) {
  was_held_ = false;
  state_.time_left_s += std::clamp(elapsed_s, 0.0F, frame_max_s);
  for (; state_.time_left_s >= tick_s; state_.time_left_s -= tick_s) tick(input, ground);
}

void Walker::speed_up(const WalkInput& input) {
  glm::vec3 wanted = level(input.go) * ((input.fast ? run_m_s : walk_m_s) * state_.pace);
  const float part = glm::length(level(input.go));
  if (part > 1.0F) wanted /= part;
  const glm::vec3 change = wanted - level(state_.speed_m_s);
  const float most = (state_.stands ? grip_m_s2 : air_grip_m_s2) * tick_s;
  const float size = glm::length(change);
  state_.speed_m_s += size <= most ? change : change * (most / size);
  if (state_.stands && input.jump) {
    state_.speed_m_s.y = jump_m_s;
    state_.stands = false;
    state_.still_ticks = 0;
  }
  state_.speed_m_s.y = std::max(state_.speed_m_s.y - fall_m_s2 * tick_s, -fall_max_m_s);
}

void Walker::leave_rock(WalkGround& ground) {
  was_held_ = false;
  if (!is_free(state_.feet_m, ground)) come_out(ground);
}

void Walker::tick(const WalkInput& input, WalkGround& ground) {
  if (!is_free(state_.feet_m, ground)) come_out(ground);
  speed_up(input);
  const bool stood = state_.stands;
  const glm::vec3 before_m = state_.feet_m;
  const glm::vec3 way_m = state_.speed_m_s * tick_s;
  const int parts = std::max(ceil_to_int(glm::length(way_m) / move_max_m), 1);
  bool carried = false;
  for (int i = 0; i < parts; ++i) carried = move(way_m / static_cast<float>(parts), ground) || carried;
  state_.stands = carried && state_.speed_m_s.y <= 0.0F;
  if (stood && !state_.stands && state_.speed_m_s.y <= 0.0F) follow_down(ground);
  if (state_.stands) state_.speed_m_s.y = 0.0F;
  note_wedged(before_m);
  const glm::vec3 half(limits::world_half_width_m, limits::world_half_height_m, limits::world_half_width_m);
  state_.feet_m = glm::clamp(state_.feet_m, -half, half);
}

/// One part of a tick's way. Whether ground carries the body.
bool Walker::move(glm::vec3 by_m, WalkGround& ground) {
  Settled to = settle(state_.feet_m + by_m, ground);
  const glm::vec3 over_m = level(by_m);
  const float wanted_m = glm::length(over_m);
  const auto progress_m = [&] {
    return glm::dot(level(to.feet_m - state_.feet_m), over_m) / std::max(wanted_m, 1e-6F);
  };
  const bool blocked = !is_free(to.feet_m, ground) || (to.wall && progress_m() < 0.5F * wanted_m);
  if (blocked && state_.stands && wanted_m > 1e-4F && step_up(over_m, ground)) return true;
  if (to.wall) {
    const float into = glm::dot(state_.speed_m_s, *to.wall);
    if (into < 0.0F) {
      const float fall_m_s = state_.speed_m_s.y;
      state_.speed_m_s -= *to.wall * into;
      // A wall takes no fall away, a ceiling takes the rise.
      state_.speed_m_s.y = to.wall->y >= 0.0F ? fall_m_s : std::min(state_.speed_m_s.y, 0.0F);
    }
  }
  if (!is_free(to.feet_m, ground)) {
    state_.speed_m_s = {0.0F, std::min(state_.speed_m_s.y, 0.0F), 0.0F};
    to = settle(state_.feet_m + glm::vec3(0.0F, by_m.y, 0.0F), ground);
    if (!is_free(to.feet_m, ground)) return to.carried;
  }
  state_.feet_m = to.feet_m;
  return to.carried;
}

/// Onto a step that is not too high, where there is ground to stand on behind its edge.
bool Walker::step_up(glm::vec3 over_m, WalkGround& ground) {
  constexpr float rise_m = 0.1F;
  const glm::vec3 ahead_m = glm::normalize(over_m) * (radius_m + 0.05F);
  float height_m = 0.0F;
  while (height_m < step_m) {
    height_m += rise_m;
    if (!is_free(state_.feet_m + up * height_m, ground)) return false;
    if (!is_free(state_.feet_m + up * height_m + over_m, ground) ||
        !is_free(state_.feet_m + up * height_m + ahead_m, ground))
      continue;
    const Settled landing = settle(state_.feet_m + up * (height_m - rise_m) + ahead_m, ground);
    if (!landing.carried || landing.feet_m.y - state_.feet_m.y > step_m) return false;
    state_.feet_m += up * height_m + over_m;
    return true;
  }
  return false;
}

/// Down a slope or a step, instead of off it.
void Walker::follow_down(WalkGround& ground) {
  constexpr float part_m = 0.05F;
  for (float down_m = part_m; down_m <= step_m * 0.6F; down_m += part_m) {
    const Settled to = settle(state_.feet_m - up * down_m, ground);
    if (!to.carried) continue;
    if (!is_free(to.feet_m, ground)) return;
    state_.feet_m = to.feet_m;
    state_.stands = true;
    return;
  }
}

/// Rock came to where the body is.
void Walker::come_out(WalkGround& ground) {
  constexpr float rise_m = 0.05F;
  const Settled to = settle(state_.feet_m, ground);
  const bool near = glm::distance(to.feet_m, state_.feet_m) < 2.0F * radius_m;
  const bool is_out = near && is_free(to.feet_m, ground);
  was_held_ = was_held_ || !is_out;
  state_.feet_m = is_out ? to.feet_m : state_.feet_m + up * rise_m;
  state_.speed_m_s = glm::vec3(0.0F);
}

/// Between steep walls that hold the body, one can jump, too.
void Walker::note_wedged(glm::vec3 before_m) {
  const bool still = !state_.stands && glm::distance(before_m, state_.feet_m) < 1e-3F;
  state_.still_ticks = still ? state_.still_ticks + 1 : 0;
  if (state_.still_ticks < wedged_ticks) return;
  state_.stands = true;
  state_.speed_m_s.y = 0.0F;
}

namespace {

constexpr bool is_within(glm::vec3 v, float most) {
  return v.x >= -most && v.x <= most && v.y >= -most && v.y <= most && v.z >= -most && v.z <= most;
}

}  // namespace

bool is_walker_state(const WalkerState& state) {
  constexpr float speed_max_m_s = 2.0F * fall_max_m_s;
  return is_within(state.feet_m, limits::world_half_width_m) &&
         state.feet_m.y >= -limits::world_half_height_m && state.feet_m.y <= limits::world_half_height_m &&
         is_within(state.speed_m_s, speed_max_m_s) && state.time_left_s >= 0.0F &&
         state.time_left_s < tick_s && state.still_ticks >= 0 && state.pace >= 0.0F &&
         state.pace <= limits::walk_pace_max;
}

bool is_walk_input(const WalkInput& input) {
  constexpr float rounding = 1.001F;
  return is_within(input.go, rounding);
}

}  // namespace scree
