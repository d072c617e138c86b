#include "server/world/blow_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "server/world/impact_stage.h"
#include "server/world/limits.h"
#include "server/world/neck.h"
#include "server/world/rules.h"
#include "shared/base/check.h"
#include "shared/base/roots.h"
#include "shared/falling/blow_search.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

struct Strike {
  const TerrainBlow* blow = nullptr;
  BlowLoad load;
};

/// The rock under a contact: some way below the surface, because its voxels' middles are.
std::optional<VoxelCoord> rock_at(const World::State& state, glm::vec3 point_m, glm::vec3 normal) {
  const float dx = state.config.terrain.voxel_size_m;
  for (const float depth : {0.5F, 0.25F, 1.0F, 1.5F, 2.0F}) {
    const glm::vec3 at = (point_m - normal * (depth * dx)) / dx + 0.5F;
    const VoxelCoord voxel{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
    const VoxelCoord inside = voxel - first_voxel(brick_of(voxel));
    if (state.field.brick(brick_of(voxel))
            .codes[static_cast<size_t>(Brick::index(inside.x, inside.y, inside.z))] < 0)
      return voxel;
  }
  return std::nullopt;
}

/// Nothing where the contact found no rock, or the blow is too weak for anything.
std::optional<Strike> strike_of(const World::State& state, const TerrainBlow& blow) {
  const bool is_prop = state.props.contains(blow.id);
  if (is_prop && blow.impulse_n_s < limits::prop_blow_min_n_s) return std::nullopt;
  Strike strike{&blow, {}};
  for (const glm::vec3 point_m : blow.points_m)
    if (const auto voxel = rock_at(state, point_m, blow.normal)) strike.load.on.push_back(*voxel);
  if (strike.load.on.empty()) return std::nullopt;
  std::ranges::sort(strike.load.on);
  strike.load.on.erase(std::unique(strike.load.on.begin(), strike.load.on.end()), strike.load.on.end());
  const float dx = state.config.terrain.voxel_size_m;
  const Material ground = material_at(state.field, blow.point_m - blow.normal * (0.5F * dx));
  float hardness_pa = state.palette->row_or_first(ground).dent_resistance_j_m3;
  if (!is_prop)  // a prop is not dented, so that the ground is the softer one
    hardness_pa = std::min(hardness_pa, struck_row(state, blow.id, blow.point_m).dent_resistance_j_m3);
  const float newtons = force_of_blow(blow.energy_j(), hardness_pa);
  if (newtons < limits::blow_min_n) return std::nullopt;
  strike.load.at = glm::dvec3(blow.point_m / dx);
  strike.load.newtons = glm::dvec3(-blow.normal * newtons);
  return strike;
}

/// A piece that was made in this tick strikes the hole that it was blown out of: that was the blast's to
/// break.
std::vector<Strike> strikes_of(const World::State& state, const TickDelta& delta) {
  const PieceId first_new = delta.spawned.empty() ? state.next_piece : delta.spawned.front().id;
  std::vector<Strike> strikes;
  for (const TerrainBlow& blow : state.bodies.terrain_blows()) {
    const bool is_old_piece = state.pieces.contains(blow.id) && blow.id < first_new;
    if (!is_old_piece && !state.props.contains(blow.id)) continue;
    if (auto strike = strike_of(state, blow)) strikes.push_back(std::move(*strike));
  }
  std::ranges::stable_sort(strikes, std::ranges::greater{},
                           [](const Strike& strike) { return glm::length(strike.load.newtons); });
  return strikes;
}

void charge(World::State& state, const BlowFound& found) {
  state.work.spend(limits::blow_part_cost_us * static_cast<float>(found.parts) +
                   limits::span_brick_cost_us * static_cast<float>(found.span_bricks) +
                   limits::span_joint_cost_us * static_cast<float>(found.span_joints) +
                   limits::span_product_cost_us * static_cast<float>(found.span_products));
}

/// Breaks off what was found. Returns the part of the impulse that the body bore.
float break_off(World::State& state, const TerrainBlow& blow, const BlowFound& found, TickDelta& delta) {
  const float share = std::clamp(static_cast<float>(found.share), 0.0F, 1.0F);
  const float energy_share = share * std::sqrt(share);
  const float kept = std::sqrt(1.0F - energy_share);
  NeckPush push;
  push.direction = -blow.normal;
  push.speed_m_s = kept * blow.speed_m_s;
  push.momentum_n_s = (1.0F - kept) * blow.impulse_n_s;
  push.energy_j = energy_share * blow.energy_j();
  crush_necks(state, *found.overload, state.traits_of(blow.id).owner, &push, delta);
  state.bodies.give_back(blow.id, blow.normal * (-kept * blow.own_n_s), blow.point_m);
  return 1.0F - kept;
}

/// Nothing where the terrain holds.
std::optional<float> search(World::State& state, const Strike& strike, TickDelta& delta) {
  const BlowFound found = find_break(state.field, *state.palette, strike.load, limits::blow_reach_bricks,
                                     state.regions.holding());
  state.regions.remember_held({});
  charge(state, found);
  if (!found.overload || region_of_necks(state, *found.overload) != nullptr) return std::nullopt;
  const size_t pieces = state.pieces.size() + found.overload->necks.size() * limits::neck_seeds_max;
  if (pieces > state.config.pieces_max) {
    ++delta.work.blows_left_out;
    return std::nullopt;
  }
  return break_off(state, *strike.blow, found, delta);
}

}  // namespace

float force_of_blow(float energy_j, float hardness_pa) {
  constexpr float by_cap = 2.44F;  // 15/16 π r² of a cap of the volume 1.325 r³
  // Steel is harder, and blows are stronger, than what cube_root() takes.
  const auto root = [](float of) { return 100.0F * cube_root(1e-6F * of); };
  return by_cap * root(hardness_pa) * root(energy_j) * root(energy_j);
}

std::map<PieceId, float> break_terrain(World::State& state, TickDelta& delta) {
  std::map<PieceId, float> borne;
  if (state.config.rules < rules::blows || !state.config.methods.dents || !state.config.methods.islands)
    return borne;
  const std::vector<Strike> strikes = strikes_of(state, delta);
  TurnQueue<WaitingWork>& turns = state.turns.blows;
  for (size_t i = 0; i < strikes.size(); ++i)
    if (!surely_holds(state.field, *state.palette, strikes[i].load))
      turns.push(state.party_of(strikes[i].blow->id), {i});
  turns.begin_tick();
  uint32_t searches = 0;
  while (!turns.empty()) {
    const Strike& strike = strikes[turns.next().index];
    const float left_us = state.work.left_us();
    if (searches < limits::blows_per_tick_max && state.work.affords(limits::blow_cost_us)) {
      ++searches;
      if (const auto part = search(state, strike, delta)) borne[strike.blow->id] = *part;
    } else {
      ++delta.work.blows_left_out;
    }
    turns.pop(left_us - state.work.left_us());
  }
  return borne;
}

}  // namespace scree
