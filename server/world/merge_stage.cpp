#include "server/world/merge_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "server/work/limits.h"
#include "server/world/buried_stage.h"
#include "server/world/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/operation/prepared_stamp.h"
#include "shared/operation/price.h"
#include "shared/operation/stamp_groups.h"
#include "shared/recombine/posed_piece.h"

namespace scree {

namespace {

/// How pieces merge. Where none merges, prices go by the plainest method.
StampMethod merge_method(const World::State& state) {
  return stamp_method_of(state.config.methods.recombine).value_or(smallest_stamp);
}

/// What a tick has for pieces at rest: so many, and microseconds for all of them.
struct RestAllowance {
  size_t pieces = 0;
  float most_us = 0.0F;
};

/// Whether the piece touches terrain that is about to fall: as terrain it would hold that up. Where nothing
/// fell for long, falls wait for room, which merges make.
bool leans_on_a_fall(const World::State& state, PieceId id) {
  if (state.config.rules < rules::joints || state.islands.size() == 0) return false;
  if (state.tick - state.island_at > limits::lean_s_max * state.config.tick_rate_hz) return false;
  const float dx = state.config.terrain.voxel_size_m;
  const VoxelBox box = posed_bounds(*state.pieces.at(id), quantise(state.bodies.state(id).pose), dx);
  return state.islands.hangs_at(box.grown(1));
}

/// The pieces that merge, or freeze, in this tick: as many as are allowed, one at least. They come layer by
/// layer, from the ground up, and by the parties' turns within each. `layers`: of RestDetector.
std::vector<PieceId> in_turn(World::State& state, const std::vector<PieceId>& ready,
                             std::span<const uint32_t> layers, const RestAllowance& allowance) {
  TurnQueue<WaitingPiece>& turns = state.turns.merges;
  std::vector<PieceId> now;
  float sum_us = 0.0F;
  for (size_t at = 0; at < ready.size() && now.size() == at;) {
    const uint32_t layer = layers[at];
    for (; at < ready.size() && layers[at] == layer; ++at)
      if (!leans_on_a_fall(state, ready[at]))
        turns.push(state.party_of(ready[at]), {ready[at], merge_cost_us(state, ready[at])});
    turns.begin_tick();
    while (!turns.empty() && now.size() < allowance.pieces) {
      const WaitingPiece next = turns.next();
      sum_us += next.cost_us;
      if (sum_us > allowance.most_us && !now.empty()) break;
      turns.pop(next.cost_us);
      now.push_back(next.piece);
    }
    turns.clear();
  }
  return now;
}

}  // namespace

float merge_cost_us(const World::State& state, PieceId id) {
  return merge_price_us(merge_method(state), static_cast<float>(state.pieces.at(id)->window.codes.size()));
}

float least_merge_cost_us(const World::State& state) {
  return merge_price_us(merge_method(state), 0.0F);
}

namespace {

/// The root of twice its energy over its mass, with a ball's moment of inertia.
float energy_speed_m_s(const BodyState& body, float reach_m) {
  const float spin2 = glm::dot(body.spin_rad_s, body.spin_rad_s);
  return std::sqrt(glm::dot(body.velocity_m_s, body.velocity_m_s) + 0.4F * reach_m * reach_m * spin2);
}

}  // namespace

void settle(World::State& state, TickDelta& delta) {
  const bool merging = merges(state.config.methods.recombine);
  std::vector<RestPiece> alive;
  for (const BodyState& body : state.bodies.states())
    if (const float reach_m = state.bodies.reach_m(body.id);
        !body.frozen && !state.props.contains(body.id) && !state.traits_of(body.id).kept)
      alive.push_back({body.id, body.pose, reach_m, energy_speed_m_s(body, reach_m), body.velocity_m_s});
  const BodyContacts contacts = state.bodies.contacts();
  std::vector<RestSupport> supports;
  for (const Carried& carried : contacts.carried) supports.push_back({carried.upper, carried.lower});
  delta.work.merging_sooner = merging && state.work.crowded();
  const std::vector<PieceId> ready =
      state.rest.update(alive, contacts.on_terrain, supports, alive.size(), delta.work.merging_sooner);
  const RestAllowance for_merges{state.config.merges_per_tick_max,
                                 std::max(state.work.left_us(), limits::merge_least_us)};
  const RestAllowance for_freezes{limits::freezes_per_tick_max, std::numeric_limits<float>::max()};
  std::vector<PieceId> now = in_turn(state, ready, state.rest.layers(), merging ? for_merges : for_freezes);
  state.rest.put_off_more(ready.size() - now.size());
  if (!merging) {
    for (const PieceId id : now)
      if (!state.bodies.is_joined(id)) state.bodies.freeze(id);
    return;
  }
  delta.work.merges_put_off = static_cast<uint32_t>(state.rest.put_off());
  for (const PieceId id : now) state.work.spend(merge_cost_us(state, id));
  state.at_rest = std::move(now);
}

namespace {

/// The smaller pieces that lie in a merging piece's volume, as rubble under a heavy piece does. Merged before
/// it they become terrain with all their mass; afterwards there would be no room for it.
std::vector<PieceId> enclosed_by(const World::State& state, PieceId id) {
  const Volume& volume = *state.pieces.at(id);
  const float dx = state.config.terrain.voxel_size_m;
  const Pose pose = state.bodies.state(id).pose;
  const glm::vec3 centre = pose.position_m / dx;
  const glm::quat back = glm::conjugate(pose.rotation);
  const auto inside = [&](glm::vec3 p_voxels) {
    const glm::vec3 at = back * (p_voxels - centre) + volume.centre_voxels;
    const VoxelCoord voxel{floor_to_int(at.x + 0.5F), floor_to_int(at.y + 0.5F), floor_to_int(at.z + 0.5F)};
    return volume.window.box.holds(voxel) && volume.window.at(voxel.x, voxel.y, voxel.z) < 0;
  };
  std::vector<PieceId> found = pieces_within(state, posed_bounds(volume, quantise(pose), dx), inside);
  std::erase_if(found, [&](PieceId other) { return state.pieces.at(other)->mass >= volume.mass; });
  return found;
}

/// The pieces in their order, each after those that it would enclose, none twice.
std::vector<PieceId> with_enclosed(const World::State& state, const std::vector<PieceId>& ids) {
  std::vector<PieceId> order;
  std::set<PieceId> known;
  const auto add = [&](PieceId id) {
    if (known.insert(id).second) order.push_back(id);
  };
  for (const PieceId id : ids) {
    if (known.contains(id)) continue;
    for (const PieceId inner : enclosed_by(state, id)) add(inner);
    add(id);
  }
  return order;
}

/// The settings' method, or another one where its window would be too large: the ball of a box.
StampMethod method_for(const World::State& state, const StampedPiece& piece) {
  const StampMethod wanted = merge_method(state);
  const VoxelBox box =
      stamp_box(wanted, *state.pieces.at(piece.piece), piece.pose, state.config.terrain.voxel_size_m);
  return Window::count(box) <= limits::stamp_voxels_max ? wanted : smallest_stamp;
}

/// What a piece becomes.
Brings brings(const World::State& state, PieceId id) {
  const bool is_stone = state.pieces.at(id)->mass <= limits::rubble_voxels_max * units_per_voxel;
  return is_stone && state.config.rules >= rules::rubble ? Brings::rubble : Brings::materials;
}

/// The plan for one piece. Where redistancing would close gaps between earlier merges that hold more mass
/// than the piece and all dust have, the piece merges by a method that never gains too much.
PreparedStamp prepare_one(World::State& state, const StampedPiece& piece, MassUnits mass, MassUnits budget) {
  PreparedStamp prepared = prepare_stamp(state.field, state.pieces, piece.piece, piece.pose,
                                         method_for(state, piece), budget, brings(state, piece.piece));
  if (prepared.gain <= mass + state.ledger.dust) return prepared;
  return prepare_stamp(state.field, state.pieces, piece.piece, piece.pose, bounded_stamp, budget,
                       brings(state, piece.piece));
}

/// The field gains the pieces' mass, and with it dust that earlier merges could not place.
void merge_group(World::State& state, const std::vector<StampedPiece>& group, TickDelta& delta) {
  CHECK(!group.empty() && group.size() <= limits::stamp_group_max);
  MassUnits mass = 0;
  for (const StampedPiece& one : group) mass += state.pieces.at(one.piece)->mass;
  const MassUnits budget = stamp_budget(mass, state.ledger.dust);
  const StampedPiece& first = group.front();
  const StampMethod method = merge_method(state);
  const Brings what = brings(state, first.piece);
  const bool are_alike =
      std::ranges::all_of(group, [&](const StampedPiece& one) { return brings(state, one.piece) == what; });
  const PreparedStamp prepared = group.size() > 1
                                     ? prepare_group(state.field, state.pieces, group, method, budget, what)
                                     : prepare_one(state, first, mass, budget);
  if (!are_alike || prepared.gain > mass + state.ledger.dust) {
    CHECK(group.size() > 1);
    for (const StampedPiece& one : group) merge_group(state, {one}, delta);
    return;
  }
  const bool all_fell =
      std::ranges::all_of(group, [&](const StampedPiece& one) { return state.traits_of(one.piece).fell; });
  const uint64_t party = state.traits_of(first.piece).owner;
  for (const StampedPiece& one : group) state.bodies.remove(one.piece);
  const Applied applied = state.apply_and_record(prepared.operation, party, delta, &prepared);
  // Flakes that hang loose now fall; but a flake that merges as it lay would fall again, and so for ever.
  if (!all_fell) state.loosen(party, applied.changed);
  CHECK_EQ(applied.terrain_gain, prepared.gain);
  state.ledger.pieces -= mass;
  state.ledger.dust += mass - applied.terrain_gain;
}

}  // namespace

void merge_pieces(World::State& state, const std::vector<PieceId>& ids, TickDelta& delta) {
  std::vector<StampedPiece> places;
  for (const PieceId id : with_enclosed(state, ids))
    places.push_back({id, quantise(state.bodies.state(id).pose)});
  const bool grouping = state.config.methods.group_merges && lays(merge_method(state));
  if (!grouping) {
    for (const StampedPiece& one : places) merge_group(state, {one}, delta);
    return;
  }
  for (const auto& group : stamp_groups(places, state.pieces, state.config.terrain.voxel_size_m))
    merge_group(state, group, delta);
}

void merge(World::State& state, TickDelta& delta) {
  merge_pieces(state, std::exchange(state.at_rest, {}), delta);
}

}  // namespace scree
