#include "server/world/island_stage.h"

#include <algorithm>
#include <utility>

#include "server/world/limits.h"
#include "server/world/spawn.h"
#include "shared/field/specks.h"

namespace scree {

namespace {

/// Whether the island is still there: an earlier one of this tick may have been the same.
bool still_there(Field& field, const Island& island) {
  const VoxelCoord v = island.seed;
  return field.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
}

void drop(World::State& state, const Island& island, TickDelta& delta) {
  if (!still_there(state.field, island)) return;
  const Applied applied =
      state.apply_and_record(IslandOperation{island.box, island.seed, state.next_piece}, delta);
  state.ledger.moved -= applied.terrain_gain;
  state.ledger.dust += applied.dust;
  state.ledger.pieces -= applied.terrain_gain + applied.dust;
  state.islands.changed(applied.changed);
  const float dx = state.config.terrain.voxel_size_m;
  const auto at_rest = [&](PieceId, const Volume& volume) {
    Newborn born;
    born.body.pose.position_m = volume.centre_voxels * dx;
    born.may_be_concave = true;
    return born;
  };
  spawn(state, applied, at_rest, delta);
}

/// One search, or several where cuts of many ticks have waited for islands to be switched on: a search over
/// all of them would start afresh with every change anywhere among them.
void take_cuts(World::State& state) {
  std::vector<BrickCoord> part;
  for (const BrickCoord brick : state.cut) {
    part.push_back(brick);
    if (part.size() == limits::island_cut_bricks_max) state.islands.push(std::exchange(part, {}));
  }
  state.islands.push(std::move(part));
  state.cut.clear();
}

}  // namespace

void IslandQueue::push(std::vector<BrickCoord> cut) {
  if (!cut.empty()) waiting_.push_back({std::move(cut), nullptr, 0});
}

std::vector<BrickCoord> IslandQueue::waiting() const {
  std::vector<BrickCoord> bricks;
  for (const Waiting& waiting : waiting_) bricks.insert(bricks.end(), waiting.cut.begin(), waiting.cut.end());
  return bricks;
}

void IslandQueue::changed(std::span<const BrickCoord> bricks) {
  for (Waiting& waiting : waiting_) {
    if (waiting.search == nullptr) continue;
    const IslandSearch& search = *waiting.search;
    if (std::ranges::none_of(bricks, [&](BrickCoord brick) { return search.visited(brick); })) continue;
    waiting.search.reset();
    ++waiting.restarts;
  }
}

std::optional<std::vector<Island>> IslandQueue::next(Field& field, size_t& bricks) {
  if (waiting_.empty() || bricks == 0) return std::nullopt;
  Waiting& first = waiting_.front();
  if (first.search == nullptr) first.search = std::make_unique<IslandSearch>(field, first.cut);
  const unsigned doublings = std::min(first.restarts, limits::island_doublings_max);
  size_t own = bricks << doublings;
  const bool finished = first.search->advance(own);
  bricks = own >> doublings;
  if (!finished) return std::nullopt;
  std::vector<Island> islands = first.search->islands();
  waiting_.pop_front();
  return islands;
}

void drop_islands(World::State& state, TickDelta& delta) {
  const std::vector<BrickCoord> changed(state.changed.begin(), state.changed.end());
  state.islands.changed(changed);
  if (!state.methods.islands) return;
  take_cuts(state);
  size_t bricks = limits::island_bricks_per_tick;
  std::vector<BrickCoord> later;
  while (const auto islands = state.islands.next(state.field, bricks))
    for (const Island& island : *islands) {
      if (state.pieces.size() < state.config.pieces_max) {
        drop(state, island, delta);
      } else {
        later.push_back(brick_of(island.seed));
      }
    }
  state.islands.push(std::move(later));
}

void sweep_specks(World::State& state, TickDelta& delta) {
  // What one leaves behind may make its neighbour light enough: again, until none is left.
  while (!state.unswept.empty()) {
    const std::vector<BrickCoord> bricks(state.unswept.begin(), state.unswept.end());
    state.unswept.clear();
    for (const Island& speck : find_specks(state.field, bricks)) drop(state, speck, delta);
  }
}

}  // namespace scree
