#include "server/world/cut_stage.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

ShatterOperation operation_of(const World::State& state, const PendingCut& cut, const BodyState& body) {
  const Volume& volume = *state.pieces.at(cut.piece);
  const glm::vec3 off_m = glm::conjugate(body.pose.rotation) * (cut.impact_m - body.pose.position_m);
  const auto voxels = static_cast<float>(volume.window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels, limits::polygons_later_us);
  return {.piece = cut.piece,
          .pattern = cut.pattern,
          .seeds = pieces_at_once(cutter, voxels, cut.pieces),
          .random_seed = cut.random_seed + cut.piece,
          .impact_voxels = volume.centre_voxels + off_m / state.config.terrain.voxel_size_m,
          .first_piece = state.next_piece,
          .cutter = cutter};
}

void share_out(World::State& state, const Applied& applied, const PendingCut& of_all) {
  MassUnits mass = 0;
  for (const CreatedPiece& created : applied.created) mass += state.pieces.at(created.id)->mass;
  if (mass == 0 || of_all.pieces <= applied.created.size()) return;
  if (of_all.piece != 0 && applied.created.size() < 2) return;  // it cannot be cut, now or later
  for (const CreatedPiece& created : applied.created) {
    PendingCut cut = of_all;
    if (cut.piece != 0) cut.thrown_by = nullptr;  // its parts were thrown when it was cut
    cut.piece = created.id;
    cut.pieces = static_cast<uint32_t>(state.pieces.at(created.id)->mass * of_all.pieces / mass);
    if (cut.pieces >= 2) state.cuts.push_back(cut);
  }
}

void cut_piece(World::State& state, const PendingCut& cut, ShatterOperation operation, TickDelta& delta) {
  const BodyState body = state.bodies.state(cut.piece);
  const PieceTraits traits = state.traits_of(cut.piece);
  const glm::vec3 centre_voxels = state.pieces.at(cut.piece)->centre_voxels;
  state.bodies.remove(cut.piece);
  const Applied applied = state.apply_and_record(operation, delta);
  CHECK_EQ(applied.terrain_gain, 0);
  state.ledger.pieces -= applied.dust;
  state.ledger.dust += applied.dust;
  const float dx = state.config.terrain.voxel_size_m;
  const auto born = [&](PieceId id, const Volume& volume) {
    Newborn part{part_of(body, (volume.centre_voxels - centre_voxels) * dx), traits};
    if (cut.thrown_by != nullptr) {
      const BodyState flight = thrown(id, part.body.pose.position_m, *cut.thrown_by);
      part.body.velocity_m_s += flight.velocity_m_s;
      part.body.spin_rad_s += flight.spin_rad_s;
    }
    return part;
  };
  spawn(state, applied, born, delta);
  share_out(state, applied, cut);
}

}  // namespace

void cut_on_later(World::State& state, const Applied& applied, const CarveRequest& request, uint32_t wanted,
                  bool whole) {
  state.cut_at = state.tick;
  share_out(state, applied,
            {.pieces = wanted,
             .pattern = is_drawn(request.pattern) ? request.pattern : plain_pattern,
             .random_seed = request.random_seed,
             .impact_m = request.impact_m,
             .thrown_by = whole ? std::make_shared<const CarveRequest>(request) : nullptr});
}

void cut_pieces(World::State& state, TickDelta& delta) {
  const auto rest = static_cast<Tick>(limits::cut_rest_s * static_cast<float>(state.config.tick_rate_hz));
  while (!state.cuts.empty()) {
    const PendingCut cut = state.cuts.front();
    const size_t others = state.pieces.size() - 1;
    if (!state.bodies.contains(cut.piece) || others + 2 > state.config.pieces_max) {
      state.cuts.pop_front();
      continue;
    }
    ShatterOperation operation = operation_of(state, cut, state.bodies.state(cut.piece));
    operation.seeds =
        std::min<uint32_t>(operation.seeds, static_cast<uint32_t>(state.config.pieces_max - others));
    const float price =
        cut_price_us(operation.cutter, static_cast<float>(state.pieces.at(cut.piece)->window.codes.size()),
                     operation.seeds);
    // A whole volume is thrown when it is cut, so it is next.
    const Tick wait = cut.thrown_by != nullptr ? 1 : rest;
    const bool fits = state.work.affords(price) && !state.work.crowded();
    if (!fits && state.tick - state.cut_at < wait) break;
    state.cut_at = state.tick;
    state.cuts.pop_front();
    cut_piece(state, cut, operation, delta);
    state.work.spend(price);
  }
  delta.work.cuts_put_off = static_cast<uint32_t>(state.cuts.size());
}

}  // namespace scree
