#include "server/world/refracture_stage.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/fracture/seeds.h"

namespace scree {

namespace {

/// Pieces of a natural break of which each part of it, cut in stages, gets at least so many.
constexpr uint32_t natural_pieces_min = 40;
constexpr uint32_t natural_parts_min = 5;

/// The blow in the frame of a piece's volume: that of the terrain that it was cut from, however it has flown.
glm::vec3 impact_voxels(const World::State& state, const PendingRefracture& pending) {
  return pending.impact_m / state.config.terrain.voxel_size_m;
}

ShatterOperation operation_of(const World::State& state, const PendingRefracture& pending,
                              const BodyState& body) {
  const Volume& volume = *state.pieces.at(pending.piece);
  const glm::vec3 off_m = glm::conjugate(body.pose.rotation) * (pending.impact_m - body.pose.position_m);
  const auto voxels = static_cast<float>(volume.window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels, limits::polygons_later_us);
  const float dx = state.config.terrain.voxel_size_m;
  const bool by_place = state.config.rules >= rules::by_place;
  const uint32_t which = by_place ? number_of_place(volume.centre_voxels * dx) : pending.piece;
  ShatterOperation operation{
      .piece = pending.piece,
      .pattern = pending.pattern,
      .seeds = pieces_at_once(cutter, voxels, pending.pieces),
      .random_seed = pending.random_seed + which,
      .impact_voxels = by_place ? impact_voxels(state, pending) : volume.centre_voxels + off_m / dx,
      .first_piece = state.next_piece,
      .cutter = cutter};
  if (operation.seeds < pending.pieces) begin_in_stages(operation.pattern, operation.seeds, pending.pieces);
  return operation;
}

/// Price of its next cut; none when the piece is gone.
float next_cut_us(const World::State& state, const PendingRefracture& pending) {
  const auto piece = state.pieces.find(pending.piece);
  if (piece == state.pieces.end()) return 0.0F;
  const auto voxels = static_cast<float>(piece->second->window.codes.size());
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels, limits::polygons_later_us);
  return cut_price_us(cutter, voxels, pieces_at_once(cutter, voxels, pending.pieces));
}

/// Each piece's share of the seeds of all, up to a factor that all have in common.
std::vector<SeedsDue> shares_of(const World::State& state, const Applied& applied,
                                const PendingRefracture& of_all) {
  std::vector<const Volume*> parts;
  for (const CreatedPiece& created : applied.created) parts.push_back(state.pieces.at(created.id).get());
  if (state.config.rules >= rules::by_place)
    return seeds_due(parts, of_all.pattern, impact_voxels(state, of_all));
  std::vector<SeedsDue> by_mass;
  for (const Volume* part : parts) by_mass.push_back({static_cast<double>(part->mass), of_all.pattern});
  return by_mass;
}

/// So many of all pieces; by place, what is rounded off goes to the next.
uint32_t pieces_of(const World::State& state, double before, double share, double sum, uint32_t all) {
  const auto up_to = [&](double part) { return static_cast<uint32_t>(part * all / sum); };
  if (state.config.rules < rules::by_place) return up_to(share);
  return up_to(before + share) - up_to(before);
}

void share_out(World::State& state, const Applied& applied, const PendingRefracture& of_all) {
  const std::vector<SeedsDue> shares = shares_of(state, applied, of_all);
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0,
                                     [](double before, const SeedsDue& due) { return before + due.share; });
  if (sum == 0.0 || of_all.pieces <= applied.created.size()) return;
  if (of_all.piece != 0 && applied.created.size() < 2) return;  // it cannot be cut, now or later
  double before = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const CreatedPiece& created = applied.created[i];
    PendingRefracture pending = of_all;
    if (pending.piece != 0) pending.thrown_by = nullptr;  // its parts were thrown when it was cut
    pending.piece = created.id;
    pending.pieces = pieces_of(state, before, shares[i].share, sum, of_all.pieces);
    pending.pattern = shares[i].pattern;
    before += shares[i].share;
    if (pending.pieces >= 2) enter_refracture(state, pending);
  }
}

void refracture_piece(World::State& state, const PendingRefracture& pending, ShatterOperation operation,
                      TickDelta& delta) {
  std::optional<Blast> blast;
  const auto throw_part = [&](PieceId id, BodyState& part) {
    if (pending.thrown_by == nullptr) return;
    if (!blast)
      blast.emplace(state, *pending.thrown_by, pending.blasted ? BlowSide::within : BlowSide::outside);
    const BodyState flight = blast->thrown(id, part.pose.position_m);
    part.velocity_m_s += flight.velocity_m_s;
    part.spin_rad_s += flight.spin_rad_s;
  };
  const Applied applied = shatter_piece(state, operation, throw_part, delta);
  if (!is_cut_on(operation.pattern)) share_out(state, applied, pending);  // else it is what it shall be
}

/// By which the wait of a cut that does not fit grows: 1 where bodies take limits::load_max of the budget or
/// less, and more in proportion, because every cut makes more bodies.
float overload(const World::State& state) {
  if (state.config.rules < rules::joints) return 1.0F;
  return std::clamp(state.work.bodies_load() / limits::load_max, 1.0F, limits::refracture_overload_max);
}

}  // namespace

void begin_in_stages(SeedPattern& pattern, uint32_t& seeds, uint32_t wanted) {
  CHECK(seeds < wanted);
  if (!is_cut_on(pattern)) return;
  pattern = SeedPattern::radial;
  seeds = std::min(seeds, std::max(natural_parts_min, wanted / natural_pieces_min));
}

void enter_refracture(World::State& state, const PendingRefracture& pending) {
  state.refractures.push(pending.party, {pending, next_cut_us(state, pending)});
}

void queue_refractures(World::State& state, const Applied& applied, const CarveRequest& request,
                       BlowSide side, uint64_t party, uint32_t wanted, bool whole) {
  state.refractured_at = state.tick;
  share_out(state, applied,
            {.pieces = wanted,
             .pattern = is_drawn(request.pattern) ? request.pattern : plain_pattern,
             .random_seed = request.random_seed,
             .impact_m = request.impact_m,
             .thrown_by = whole ? std::make_shared<const CarveRequest>(request) : nullptr,
             .party = state.charged(party),
             .blasted = side == BlowSide::within});
}

void refracture_pieces(World::State& state, TickDelta& delta) {
  const auto rest = static_cast<Tick>(limits::refracture_rest_s * overload(state) *
                                      static_cast<float>(state.config.tick_rate_hz));
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
