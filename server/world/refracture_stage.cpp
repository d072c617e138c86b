#include "server/world/refracture_stage.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

ShatterOperation operation_of(const World::State& state, const PendingRefracture& pending,
                              const BodyState& body) {
  const Volume& volume = *state.pieces.at(pending.piece);
  const glm::vec3 off_m = glm::conjugate(body.pose.rotation) * (pending.impact_m - body.pose.position_m);
  const auto voxels = static_cast<float>(volume.window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels, limits::polygons_later_us);
  return {.piece = pending.piece,
          .pattern = pending.pattern,
          .seeds = pieces_at_once(cutter, voxels, pending.pieces),
          .random_seed = pending.random_seed + pending.piece,
          .impact_voxels = volume.centre_voxels + off_m / state.config.terrain.voxel_size_m,
          .first_piece = state.next_piece,
          .cutter = cutter};
}

/// Price of its next cut; none when the piece is gone.
float next_cut_us(const World::State& state, const PendingRefracture& pending) {
  const auto piece = state.pieces.find(pending.piece);
  if (piece == state.pieces.end()) return 0.0F;
  const auto voxels = static_cast<float>(piece->second->window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels, limits::polygons_later_us);
  return cut_price_us(cutter, voxels, pieces_at_once(cutter, voxels, pending.pieces));
}

void share_out(World::State& state, const Applied& applied, const PendingRefracture& of_all) {
  MassUnits mass = 0;
  for (const CreatedPiece& created : applied.created) mass += state.pieces.at(created.id)->mass;
  if (mass == 0 || of_all.pieces <= applied.created.size()) return;
  if (of_all.piece != 0 && applied.created.size() < 2) return;  // it cannot be cut, now or later
  for (const CreatedPiece& created : applied.created) {
    PendingRefracture pending = of_all;
    if (pending.piece != 0) pending.thrown_by = nullptr;  // its parts were thrown when it was cut
    pending.piece = created.id;
    pending.pieces = static_cast<uint32_t>(state.pieces.at(created.id)->mass * of_all.pieces / mass);
    if (pending.pieces >= 2) enter_refracture(state, pending);
  }
}

void refracture_piece(World::State& state, const PendingRefracture& pending, ShatterOperation operation,
                      TickDelta& delta) {
  const BodyState body = state.bodies.state(pending.piece);
  const PieceTraits traits = state.traits_of(pending.piece);
  const glm::vec3 centre_voxels = state.pieces.at(pending.piece)->centre_voxels;
  state.bodies.remove(pending.piece);
  const Applied applied = state.apply_and_record(operation, pending.party, delta);
  CHECK_EQ(applied.terrain_gain, 0);
  state.ledger.pieces -= applied.dust;
  state.ledger.dust += applied.dust;
  const float dx = state.config.terrain.voxel_size_m;
  const auto born = [&](PieceId id, const Volume& volume) {
    Newborn part{part_of(body, (volume.centre_voxels - centre_voxels) * dx), traits};
    if (pending.thrown_by != nullptr) {
      const BodyState flight = thrown(id, part.body.pose.position_m, *pending.thrown_by);
      part.body.velocity_m_s += flight.velocity_m_s;
      part.body.spin_rad_s += flight.spin_rad_s;
    }
    return part;
  };
  spawn(state, applied, born, delta);
  share_out(state, applied, pending);
}

}  // namespace

void enter_refracture(World::State& state, const PendingRefracture& pending) {
  state.refractures.push(pending.party, {pending, next_cut_us(state, pending)});
}

void queue_refractures(World::State& state, const Applied& applied, const CarveRequest& request,
                       uint64_t party, uint32_t wanted, bool whole) {
  state.refractured_at = state.tick;
  share_out(state, applied,
            {.pieces = wanted,
             .pattern = is_drawn(request.pattern) ? request.pattern : plain_pattern,
             .random_seed = request.random_seed,
             .impact_m = request.impact_m,
             .thrown_by = whole ? std::make_shared<const CarveRequest>(request) : nullptr,
             .party = state.charged(party)});
}

void refracture_pieces(World::State& state, TickDelta& delta) {
  const auto rest =
      static_cast<Tick>(limits::refracture_rest_s * static_cast<float>(state.config.tick_rate_hz));
  const float rest_us = limits::refracture_rest_s * client_us_per_s(state.work, state.config);
  state.refractures.begin_tick();
  bool in_order = true;  // a piece whose turn it is may not fit, and those of others may
  while (!state.refractures.empty()) {
    const PendingRefracture pending = state.refractures.next().pending;
    const size_t others = state.pieces.size() - 1;
    if (!state.bodies.contains(pending.piece) || others + 2 > state.config.pieces_max) {
      state.refractures.pop(0.0F);
      continue;
    }
    ShatterOperation operation = operation_of(state, pending, state.bodies.state(pending.piece));
    operation.seeds =
        std::min<uint32_t>(operation.seeds, static_cast<uint32_t>(state.config.pieces_max - others));
    const float price = cut_price_us(operation.cutter,
                                     static_cast<float>(state.pieces.at(pending.piece)->window.codes.size()),
                                     operation.seeds);
    // A whole volume is thrown when it is cut, so it is next.
    const Tick pause = wait_for_room(state, pending.party, price, rest);
    const Tick wait = pending.thrown_by != nullptr ? 1 : pause;
    const bool fits = state.work.affords(price) && !is_crowding(state, pending.party);
    if (!fits && (!in_order || state.tick - state.refractured_at < wait)) {
      in_order = false;
      state.refractures.pass_over();
      continue;
    }
    if (in_order) state.refractured_at = state.tick;
    state.refractures.pop(fits ? price : std::max(price, part_of(rest_us, pause, rest)));
    refracture_piece(state, pending, operation, delta);
    state.work.spend(price);
  }
  delta.work.refractures_put_off = static_cast<uint32_t>(state.refractures.size());
}

}  // namespace scree
