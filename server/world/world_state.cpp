#include "server/world/world_state.h"

#include <algorithm>

#include "server/world/applied_operation.h"
#include "server/world/limits.h"
#include "server/world/settings.h"
#include "shared/base/check.h"

namespace scree {

namespace {

BodiesConfig bodies_config(const WorldConfig& config) {
  BodiesConfig out;
  out.tick_rate_hz = config.tick_rate_hz;
  out.terrain_collider = config.methods.collider;
  return out;
}

VoxelBox box_of(const std::vector<BrickCoord>& bricks) {
  CHECK(!bricks.empty());
  VoxelBox box{first_voxel(bricks.front()), first_voxel(bricks.front())};
  for (const BrickCoord brick : bricks) {
    const VoxelCoord v = first_voxel(brick);
    box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
    box.hi = {std::max(box.hi.x, v.x + brick_size), std::max(box.hi.y, v.y + brick_size),
              std::max(box.hi.z, v.z + brick_size)};
  }
  return box;
}

/// Whether terrain may be loose after the operation. Terrain around a fallen island was not connected to it;
/// a stamp's redistancing lowers some codes, but opens no gap.
bool cuts(const Operation& operation, const Applied& applied) {
  return applied.terrain_gain < 0 && !std::holds_alternative<IslandOperation>(operation) &&
         !std::holds_alternative<StampOperation>(operation);
}

}  // namespace

World::State::State(const WorldConfig& world_config)
    : config(world_config),
      methods(config.methods),
      field(config.terrain),
      bodies(field, bodies_config(config)),
      rest(RestConfig{}, config.tick_rate_hz),
      work(config.tick_rate_hz) {
  Methods parsed;
  CHECK(set_all(parsed, print(methods)) && parsed == methods);
}

Applied World::State::apply_and_record(const Operation& operation, TickDelta& delta,
                                       const PreparedStamp* prepared) {
  const VoxelBox reads = read_box(operation, pieces, config.terrain.voxel_size_m);
  Applied applied = apply(operation, field, pieces, prepared);
  CHECK_DEBUG(std::ranges::adjacent_find(applied.changed, std::ranges::greater_equal{}) ==
              applied.changed.end());
  delta.operations.push_back(describe(operation, reads, applied));
  changed.insert(applied.changed.begin(), applied.changed.end());
  if (cuts(operation, applied)) cut.insert(applied.changed.begin(), applied.changed.end());
  if (methods.support) strained.insert(applied.changed.begin(), applied.changed.end());
  if (std::holds_alternative<StampOperation>(operation) || std::holds_alternative<IslandOperation>(operation))
    unswept.insert(applied.changed.begin(), applied.changed.end());
  if (!applied.changed.empty()) bodies.terrain_changed(box_of(applied.changed));
  ledger.terrain += applied.terrain_gain;
  for (const PieceId ended : pieces_ended_by(operation)) {
    CHECK(!pieces.contains(ended));
    traits.erase(ended);
  }
  return applied;
}

void World::State::enter_taken(const Applied& applied) {
  CHECK(applied.dust >= 0);
  ledger.moved -= applied.terrain_gain;
  ledger.dust += applied.dust;
  ledger.pieces -= applied.terrain_gain + applied.dust;
}

PieceTraits World::State::traits_of(PieceId id) const {
  const auto found = traits.find(id);
  return found == traits.end() ? PieceTraits{} : found->second;
}

MassUnits World::State::mass_of_pieces() const {
  MassUnits mass = 0;
  for (const auto& [id, volume] : pieces) mass += volume->mass;
  return mass;
}

void World::State::check() const {
  CHECK(ledger.error() == 0);
  CHECK(ledger.pieces >= 0 && ledger.poured >= 0 && ledger.moved >= 0);
  CHECK_EQ(bodies.size(), pieces.size());
  CHECK_EQ(traits.size(), pieces.size());
  CHECK(pieces.empty() || pieces.rbegin()->first < next_piece);
  CHECK(waiting.size() <= limits::requests_waiting_max);
  CHECK_DEBUG(ledger.pieces == mass_of_pieces());
  CHECK_DEBUG(std::ranges::all_of(pieces, [this](const auto& piece) {
    return bodies.contains(piece.first) && traits.contains(piece.first);
  }));
}

}  // namespace scree
