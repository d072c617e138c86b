#include "server/world/piece_carving.h"

#include <algorithm>
#include <optional>
#include <string>

#include "server/work/price.h"
#include "server/world/blast.h"
#include "server/world/request_room.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/operation/limits.h"
#include "shared/operation/price.h"

namespace scree {

namespace {

/// Metres from a piece to a shape that misses it: farther than any piece reaches.
constexpr float miss_m = 64.0F;

tl::unexpected<Refused> no_piece(PieceId id) {
  return refuse(Refusal::body_missing,
                "there is no piece " + std::to_string(id) + ": it may have become terrain");
}

float voxels_in(const Volume& volume) {
  return static_cast<float>(volume.window.codes.size());
}

/// Cuts a living piece by a valid operation with a shape. `thrown` may be null: then what breaks goes on as
/// it moved. The pieces that break off are the party's.
Applied cut_piece(World::State& state, const ShatterOperation& operation, const CarveRequest* thrown,
                  uint64_t party, TickDelta& delta) {
  const BodyState body = state.bodies.state(operation.piece);
  const PieceTraits parent = state.traits_of(operation.piece);
  const glm::vec3 centre_voxels = state.pieces.at(operation.piece)->centre_voxels;
  const float dx = state.config.terrain.voxel_size_m;
  state.bodies.remove(operation.piece);
  const Applied applied = state.apply_and_record(operation, party, delta);
  CHECK_EQ(applied.terrain_gain, 0);
  state.ledger.pieces -= applied.dust;
  state.ledger.dust += applied.dust;
  const auto broken = static_cast<PieceId>(applied.created.size() - applied.rests);
  std::optional<Blast> blast;
  if (thrown != nullptr) blast.emplace(state, *thrown, BlowSide::outside);
  const auto born = [&](PieceId id, const Volume& volume) {
    Newborn part{part_of(body, (volume.centre_voxels - centre_voxels) * dx), parent};
    if (id - operation.first_piece >= broken) {
      part.may_be_concave = true;
      return part;
    }
    part.traits = {.generation = parent.generation, .owner = party};
    if (!blast) return part;
    const BodyState flight = blast->thrown(id, part.body.pose.position_m);
    part.body.velocity_m_s += flight.velocity_m_s;
    part.body.spin_rad_s += flight.spin_rad_s;
    return part;
  };
  spawn(state, applied, born, delta);
  return applied;
}

/// Lets a piece fall apart into what is connected: a cut by a shape that takes nothing. Returns the first
/// one; 0: all of it was dust.
PieceId part_piece(World::State& state, PieceId id, uint64_t party, TickDelta& delta) {
  const QuantisedPose pose = quantise(state.bodies.state(id).pose);
  glm::vec3 elsewhere_m = dequantise(pose).position_m;
  elsewhere_m.y += elsewhere_m.y > 0.0F ? -miss_m : miss_m;
  const PieceCut cut{sphere(elsewhere_m, limits::edit_reach_min_m), pose};
  const Volume& volume = *state.pieces.at(id);
  if (look_at_cut(cut, volume, state.config.terrain.voxel_size_m).rests < 2) return id;
  const ShatterOperation apart{.piece = id,
                               .pattern = plain_pattern,
                               .seeds = 1,
                               .impact_voxels = volume.centre_voxels,
                               .first_piece = state.next_piece,
                               .cutter = cheapest_cutter,
                               .cut = cut};
  const Applied applied = cut_piece(state, apart, nullptr, party, delta);
  return applied.created.empty() ? 0 : applied.created.front().id;
}

}  // namespace

CheckedRequest check_piece_carve(const World::State& state, const CarveRequest& request) {
  if (!state.pieces.contains(request.piece)) return no_piece(request.piece);
  if (is_drawn(request.pattern)) return {};
  return refuse(Refusal::carve_invalid,
                "the pattern " + std::string(name_of(request.pattern)) + " breaks no piece: it takes points");
}

CheckedRequest check(const World::State& state, const ReleaseRequest& request) {
  if (state.props.contains(request.piece))
    return refuse(Refusal::body_missing,
                  "body " + std::to_string(request.piece) + " is a prop, which never becomes terrain");
  if (!state.pieces.contains(request.piece)) return no_piece(request.piece);
  if (state.traits_of(request.piece).kept) return {};
  return refuse(Refusal::body_not_kept, "piece " + std::to_string(request.piece) +
                                            " is not kept: it becomes terrain where it comes to rest");
}

Outcome carve_piece(World::State& state, const CarveRequest& request, uint64_t party, const PieceGrant& grant,
                    TickDelta& delta) {
  const size_t others = state.pieces.size() - 1;
  const bool has_room = others + limits::cut_rests_max < state.config.pieces_max;
  if (grant.pieces == 0 || !has_room) return tl::unexpected(no_room(state, request.seeds, party, grant));
  const float dx = state.config.terrain.voxel_size_m;
  const Volume& volume = *state.pieces.at(request.piece);
  const BodyState body = state.bodies.state(request.piece);
  const PieceCut cut{request.shape, quantise(body.pose)};
  state.work.spend(rest_price_us(voxels_in(volume)));
  if (!look_at_cut(cut, volume, dx).takes)
    return refuse(Refusal::shape_misses, "the shape takes nothing of piece " + std::to_string(request.piece) +
                                             ", which is elsewhere by now");
  const auto room = static_cast<uint32_t>(state.config.pieces_max - others - limits::cut_rests_max);
  const glm::vec3 off_m = glm::conjugate(body.pose.rotation) * (request.impact_m - body.pose.position_m);
  const ShatterOperation operation{.piece = request.piece,
                                   .pattern = request.pattern,
                                   .seeds = std::min(grant.pieces, room),
                                   .random_seed = request.random_seed,
                                   .impact_voxels = volume.centre_voxels + off_m / dx,
                                   .first_piece = state.next_piece,
                                   .cutter = cutter_for(state.config.methods.cutter, voxels_in(volume)),
                                   .cut = cut};
  const CarveRequest* const thrown = request.blast_speed_m_s > 0.0F ? &request : nullptr;
  return static_cast<uint32_t>(cut_piece(state, operation, thrown, party, delta).created.size());
}

Outcome cut_out(World::State& state, const CutOutRequest& request, uint64_t party, const PieceGrant& grant,
                TickDelta& delta) {
  if (grant.pieces == 0) return tl::unexpected(no_room(state, 1, party, grant));
  if (mass_of(carved_volume(state.field, request.shape)) < limits::piece_mass_min)
    return refuse(Refusal::shape_misses, "there is no rock in the shape");
  const CarveOperation operation{.shape = request.shape,
                                 .pattern = plain_pattern,
                                 .seeds = 1,
                                 .impact_m = centre_of(request.shape),
                                 .first_piece = state.next_piece,
                                 .cutter = cheapest_cutter};
  const Applied applied = state.apply_and_record(operation, party, delta);
  state.enter_removed(applied);
  const float dx = state.config.terrain.voxel_size_m;
  const auto born = [&](PieceId, const Volume& volume) {
    Newborn kept{.body = {}, .traits = {.owner = party, .kept = true}, .may_be_concave = true};
    kept.body.pose.position_m = volume.centre_voxels * dx;
    return kept;
  };
  spawn(state, applied, born, delta);
  return applied.created.empty() ? 0U : part_piece(state, applied.created.front().id, party, delta);
}

uint32_t perform(World::State& state, const ReleaseRequest& request, uint64_t /*party*/,
                 TickDelta& /*delta*/) {
  state.traits.at(request.piece).kept = false;
  return 0;
}

}  // namespace scree
