#include "server/world/restore_requests.h"

#include <algorithm>

#include "server/world/slide_stage.h"
#include "shared/base/limits.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

/// The operation for those of its bricks that `takes` agrees to, and for pieces that there are.
template <typename Takes>
RestoreOperation operation_of(const World::State& state, const RestoreRequest& request, Takes&& takes) {
  RestoreOperation operation;
  auto bricks = std::make_shared<std::vector<BrickPatch>>();
  if (request.bricks != nullptr)
    for (const RestoreRequest::Brick& brick : *request.bricks)
      if (takes(brick)) bricks->push_back(brick.then);
  if (!bricks->empty()) operation.bricks = std::move(bricks);
  std::ranges::copy_if(request.pieces, std::back_inserter(operation.pieces),
                       [&](PieceId id) { return state.pieces.contains(id); });
  return operation;
}

/// As after any edit there: what hangs loose falls, what is too heavy breaks, rubble slides.
void look_around(World::State& state, ChunkCoord chunk, uint64_t party) {
  const std::vector<BrickCoord> bricks = state.field.edited_bricks(chunk);
  if (bricks.empty()) return;
  state.loosen(party, bricks);
  if (state.config.methods.support) state.strained[state.charged(party)].insert(bricks.begin(), bricks.end());
  if (state.config.rules >= rules::slides)
    for (const BrickCoord brick : bricks) state.slopes[state.charged(party)].insert(slope_of(brick));
}

}  // namespace

CheckedRequest check(const World::State& state, const RestoreRequest& request, uint64_t session) {
  if (session != 0) return refuse(Refusal::restore_invalid, "only the server itself does that (admin undo)");
  const auto all = [](const RestoreRequest::Brick&) { return true; };
  if (const Result<void> valid = validate(Operation(operation_of(state, request, all)), state.pieces,
                                          state.config.terrain.voxel_size_m);
      !valid)
    return refuse(Refusal::restore_invalid, valid.error().message);
  if (request.loose.size() > limits::loose_chunks_max)
    return refuse(
        Refusal::restore_invalid,
        "more loose chunks than " + std::to_string(limits::loose_chunks_max) + " (limits.loose_chunks_max)");
  if (std::ranges::any_of(request.loose,
                          [&](ChunkCoord chunk) { return !state.in_world(brick_in_chunk(chunk, 0)); }))
    return refuse(Refusal::restore_invalid, "a loose chunk is outside the world");
  return {};
}

uint32_t perform(World::State& state, const RestoreRequest& request, uint64_t party, TickDelta& delta) {
  const auto is_as_said = [&](const RestoreRequest::Brick& brick) {
    const BrickCoord coord = brick.then.coord;
    const Brick codes = state.field.brick(coord);
    return brick_hash(coord, codes, state.field.materials(coord)) == brick.now;
  };
  const RestoreOperation operation = operation_of(state, request, is_as_said);
  if (operation.bricks != nullptr || !operation.pieces.empty()) {
    MassUnits of_pieces = 0;
    for (const PieceId id : operation.pieces) of_pieces += state.pieces.at(id)->mass;
    const Applied applied = state.apply_and_record(operation, party, delta);
    state.ledger.pieces -= of_pieces;
    state.ledger.poured += applied.terrain_gain - of_pieces;
    for (const PieceId id : operation.pieces) state.bodies.remove(id);
    state.request_mass = applied.terrain_gain - of_pieces;
  }
  for (const ChunkCoord chunk : request.loose) look_around(state, chunk, party);
  return static_cast<uint32_t>(operation.pieces.size());
}

}  // namespace scree
