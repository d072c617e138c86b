#include "server/world/support_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/limits.h"
#include "server/world/rules.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/falling/spans.h"
#include "shared/falling/support_search.h"

namespace scree {

namespace {

/// The first waiting brick, and those near it.
std::vector<BrickCoord> first_cluster(const std::set<BrickCoord>& strained) {
  CHECK(!strained.empty());
  const BrickCoord first = *strained.begin();
  const auto near = [](int a, int b) { return std::abs(a - b) < limits::support_cluster_bricks; };
  std::vector<BrickCoord> cluster;
  for (const BrickCoord brick : strained) {
    if (!near(brick.x, first.x)) break;  // they are ordered by x
    if (near(brick.y, first.y) && near(brick.z, first.z)) cluster.push_back(brick);
  }
  return cluster;
}

CarveOperation crushing(const World::State& state, const VoxelBox& voxels, int64_t section_voxels) {
  const float dx = state.config.terrain.voxel_size_m;
  const auto at = [&](VoxelCoord v) {
    return (glm::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)) - 0.5F) * dx;
  };
  CHECK(!voxels.empty() && section_voxels >= 0);
  const glm::vec3 lo = at(voxels.lo), hi = at(voxels.hi);
  CarveOperation operation;
  operation.shape = box(0.5F * (lo + hi), 0.5F * (hi - lo));
  operation.seeds = static_cast<uint32_t>(
      std::clamp<int64_t>(section_voxels / limits::neck_faces_per_seed, 1, limits::neck_seeds_max));
  operation.random_seed = static_cast<uint32_t>(state.tick) * 0x9E3779B1U + state.next_piece;
  operation.impact_m = centre_of(operation.shape);
  operation.first_piece = state.next_piece;
  operation.cutter = cutter_for(state.config.methods.cutter, voxels_of(voxels));
  return operation;
}

void crush(World::State& state, const CarveOperation& operation, uint64_t party, TickDelta& delta) {
  if (!validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m))
    return;  // at the world's edge
  const float dx = state.config.terrain.voxel_size_m;
  const Applied applied = state.apply_and_record(operation, party, delta);
  state.enter_removed(applied);
  const auto thrown = [&](PieceId, const Volume& volume) {
    Newborn piece;
    piece.body.pose.position_m = volume.centre_voxels * dx;
    const glm::vec3 away = piece.body.pose.position_m - operation.impact_m;
    const float distance = std::max(std::sqrt(glm::dot(away, away)), dx);
    piece.body.velocity_m_s = away / distance * limits::neck_throw_m_s;
    piece.traits = {.generation = limits::break_generations_max, .owner = party};
    return piece;
  };
  spawn(state, applied, thrown, delta);
}

/// Crushes a box; one that is longer than the reach of an edit in halves, recursively.
void crush_by_halves(World::State& state, const VoxelBox& box, int64_t section_voxels, uint64_t party,
                     TickDelta& delta) {
  const VoxelCoord size = box.size();
  const int longest = std::max({size.x, size.y, size.z});
  const float reach_m = 0.5F * static_cast<float>(longest) * state.config.terrain.voxel_size_m;
  if (reach_m <= limits::edit_reach_max_m) {
    crush(state, crushing(state, box, section_voxels), party, delta);
    return;
  }
  VoxelBox first = box, second = box;
  int VoxelCoord::*const side = size.x == longest   ? &VoxelCoord::x
                                : size.y == longest ? &VoxelCoord::y
                                                    : &VoxelCoord::z;
  first.hi.*side = second.lo.*side = box.lo.*side + longest / 2;
  crush_by_halves(state, first, section_voxels / 2, party, delta);
  crush_by_halves(state, second, section_voxels / 2, party, delta);
}

/// False when there is no room for the pieces under WorldConfig::pieces_max: the rest waits.
bool break_off(World::State& state, const Overload& overload, uint64_t party, TickDelta& delta) {
  for (const Neck& neck : overload.necks) {
    if (state.pieces.size() + limits::neck_seeds_max > state.config.pieces_max) return false;
    crush_by_halves(state, neck.box, neck.section_voxels, party, delta);
    state.work.spend(limits::dent_cost_us);
  }
  return true;
}

/// Where nothing is too heavy for its neck and nothing is a lever: whether a span between supports breaks.
void add_spans(World::State& state, std::span<const BrickCoord> cluster, SupportFound& found) {
  if (state.config.rules < rules::spans || !found.overloads.empty()) return;
  SpansFound spans = find_spans(state.field, *state.palette, cluster);
  state.work.spend(limits::span_brick_cost_us * static_cast<float>(spans.bricks_read) +
                   limits::span_joint_cost_us * static_cast<float>(spans.joints) +
                   limits::span_product_cost_us * static_cast<float>(spans.products));
  found.overloads = std::move(spans.overloads);
}

/// Searches the party's first cluster, and breaks off what is too heavy. Whether anything was.
bool search_cluster(World::State& state, uint64_t party, TickDelta& delta) {
  std::set<BrickCoord>& strained = state.strained.at(party);
  const std::vector<BrickCoord> cluster = first_cluster(strained);
  for (const BrickCoord brick : cluster) strained.erase(brick);
  SupportFound found = find_overloads(state.field, *state.palette, cluster, limits::support_reach_bricks);
  state.work.spend(limits::support_part_cost_us * static_cast<float>(found.parts));
  delta.work.supports_given_up += found.given_up ? 1 : 0;
  add_spans(state, cluster, found);
  bool room = true;
  for (const Overload& overload : found.overloads) room = room && break_off(state, overload, party, delta);
  if (!room) state.strained[party].insert(cluster.begin(), cluster.end());
  return !found.overloads.empty();
}

}  // namespace

void break_overloads(World::State& state, TickDelta& delta) {
  if (!state.config.methods.support || !state.config.methods.islands) state.strained.clear();
  TurnQueue<WaitingWork>& turns = state.turns.supports;
  for (const auto& [party, bricks] : state.strained) turns.push(party, {});
  turns.begin_tick();
  std::set<uint64_t> broken;  // the islands of a break fall before the party's next search
  bool first = true;
  while (!turns.empty()) {
    const uint64_t party = turns.whose();
    if (broken.contains(party) || !state.islands.idle(party)) {
      turns.pass_over();
      continue;
    }
    if (!std::exchange(first, false) && !state.work.affords(0.0F)) break;
    const float left_us = state.work.left_us();
    if (search_cluster(state, party, delta)) broken.insert(party);
    const float spent_us = left_us - state.work.left_us();
    const auto strained = state.strained.find(party);
    if (!strained->second.empty()) {
      turns.go_on(spent_us, 0.0F);
      continue;
    }
    state.strained.erase(strained);
    turns.pop(spent_us);
  }
  turns.clear();
  for (const auto& [party, bricks] : state.strained)
    delta.work.supports_put_off += static_cast<uint32_t>(bricks.size());
}

}  // namespace scree
