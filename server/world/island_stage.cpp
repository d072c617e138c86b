#include "server/world/island_stage.h"

#include <algorithm>
#include <utility>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/limits.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/falling/island.h"
#include "shared/recombine/specks.h"

namespace scree {

namespace {

/// Whether the island is still there: an earlier island of this tick may have been the same.
bool still_there(Field& field, const Island& island) {
  const VoxelCoord v = island.start;
  return field.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
}

void drop(World::State& state, const Island& island, TickDelta& delta) {
  if (!still_there(state.field, island)) return;
  const Applied applied =
      state.apply_and_record(IslandOperation{island.box, island.start, state.next_piece}, delta);
  state.enter_removed(applied);
  state.islands.fell(applied.changed);
  const float dx = state.config.terrain.voxel_size_m;
  const auto at_rest = [&](PieceId, const Volume& volume) {
    Newborn born;
    born.body.pose.position_m = volume.centre_voxels * dx;
    born.may_be_concave = true;
    born.traits.fell = true;
    return born;
  };
  spawn(state, applied, at_rest, delta);
}

constexpr SearchLimits search_limits{
    .parts_max = limits::island_parts_max,
    .bricks_per_chunk = static_cast<size_t>(limits::chunk_cost_us / limits::island_brick_cost_us)};

bool has_seen(const IslandSearch& search, std::span<const BrickCoord> bricks) {
  return std::ranges::any_of(bricks, [&](BrickCoord brick) { return search.visited(brick); });
}

/// What the tick has room for, within bounds.
size_t bricks_to_read(const WorkBudget& work) {
  const float paid = std::max(work.left_us(), 0.0F) / limits::island_brick_cost_us;
  return std::clamp(static_cast<size_t>(paid), limits::island_bricks_per_tick_min,
                    limits::island_bricks_per_tick_max);
}

/// Adds one search for this tick's cuts; or several, when the cuts of many ticks waited for Methods::islands:
/// a search over all of them would restart with every change among them.
void begin_searches(World::State& state) {
  std::vector<BrickCoord> part;
  for (const BrickCoord brick : state.loosened_bricks) {
    part.push_back(brick);
    if (part.size() == limits::island_loosened_bricks_max) state.islands.push(std::exchange(part, {}));
  }
  state.islands.push(std::move(part));
  state.loosened_bricks.clear();
}

}  // namespace

void IslandQueue::push(std::vector<BrickCoord> loosened) {
  if (!loosened.empty()) waiting_.push_back({std::move(loosened), nullptr, 0});
}

std::vector<BrickCoord> IslandQueue::Falling::starts() const {
  std::vector<BrickCoord> starts;
  for (const Island& island : islands) starts.push_back(brick_of(island.start));
  return starts;
}

std::vector<LooseningEdit> IslandQueue::value() const {
  std::vector<LooseningEdit> value;
  for (const Falling& falling : falling_) value.push_back({falling.starts(), 0});
  for (const Waiting& waiting : waiting_) value.push_back({waiting.loosened, waiting.restarts});
  return value;
}

void IslandQueue::restore(const std::vector<LooseningEdit>& value) {
  falling_.clear();
  waiting_.clear();
  for (const LooseningEdit& edit : value)
    if (!edit.bricks.empty()) waiting_.push_back({edit.bricks, nullptr, edit.restarts});
}

std::vector<BrickCoord> IslandQueue::waiting() const {
  std::vector<BrickCoord> bricks;
  for (const Waiting& waiting : waiting_)
    bricks.insert(bricks.end(), waiting.loosened.begin(), waiting.loosened.end());
  return bricks;
}

void IslandQueue::fell(std::span<const BrickCoord> bricks) {
  for (Waiting& waiting : waiting_) {
    if (waiting.search == nullptr || !has_seen(*waiting.search, bricks)) continue;
    waiting.search.reset();
    ++waiting.restarts;
  }
}

void IslandQueue::changed(std::span<const BrickCoord> bricks) {
  fell(bricks);
  std::erase_if(falling_, [&](const Falling& falling) {
    if (!has_seen(*falling.search, bricks)) return false;
    push(falling.starts());
    return true;
  });
}

bool IslandQueue::search(Field& field, SearchAllowance& allowance) {
  if (waiting_.empty() || allowance.bricks == 0) return false;
  Waiting& first = waiting_.front();
  if (first.search == nullptr) {
    first.search = std::make_unique<IslandSearch>(field, first.loosened, search_limits);
    allowance.read += first.search->read();
    allowance.bricks -= std::min(allowance.bricks, first.search->read());
  }
  unsigned doublings = std::min(first.restarts, limits::island_doublings_max);
  while (doublings > 0 && allowance.bricks << doublings > limits::island_bricks_per_tick_max) --doublings;
  const size_t allowed = allowance.bricks << doublings;
  size_t left = allowed;
  const bool finished = first.search->advance(left);
  CHECK(left <= allowed);
  allowance.read += allowed - left;
  allowance.bricks = left >> doublings;
  if (!finished) return false;
  Falling falling{first.search->islands(), std::move(first.search)};
  waiting_.pop_front();
  allowance.too_large += static_cast<uint32_t>(falling.search->too_large());
  // From the ground up, so that none falls on one that waits.
  std::ranges::sort(falling.islands, std::ranges::greater{},
                    [](const Island& island) { return std::pair(island.box.lo.y, island.start); });
  if (!falling.islands.empty()) falling_.push_back(std::move(falling));
  return true;
}

void IslandQueue::pop() {
  CHECK(!falling_.empty() && !falling_.front().islands.empty());
  falling_.front().islands.pop_back();
  if (falling_.front().islands.empty()) falling_.pop_front();
}

size_t IslandQueue::falling() const {
  size_t count = 0;
  for (const Falling& falling : falling_) count += falling.islands.size();
  return count;
}

void drop_islands(World::State& state, TickDelta& delta) {
  const std::vector<BrickCoord> changed(state.changed.begin(), state.changed.end());
  state.islands.changed(changed);
  if (!state.config.methods.islands) return;
  begin_searches(state);
  SearchAllowance allowance{.bricks = bricks_to_read(state.work)};
  while (state.islands.search(state.field, allowance)) {
  }
  delta.work.islands_too_large += allowance.too_large;
  state.work.spend(limits::island_brick_cost_us * static_cast<float>(allowance.read));
  const auto rest = static_cast<Tick>(limits::island_rest_s * static_cast<float>(state.config.tick_rate_hz));
  while (const Island* next = state.islands.next()) {
    const Island island = *next;
    const float cost = lift_price_us(island.box);
    const bool fits = state.work.affords(cost) && !state.work.crowded();
    if (state.pieces.size() >= state.config.pieces_max) break;
    if (!fits && state.tick - state.island_at < rest) break;
    state.island_at = state.tick;
    state.islands.pop();
    drop(state, island, delta);
    state.work.spend(cost);
  }
  delta.work.islands_put_off = static_cast<uint32_t>(state.islands.falling());
}

void sweep_specks(World::State& state, TickDelta& delta) {
  // A speck's fall may leave another speck behind: so this repeats until none is found.
  while (!state.unswept.empty()) {
    const std::vector<BrickCoord> bricks(state.unswept.begin(), state.unswept.end());
    state.unswept.clear();
    for (const Island& speck : find_specks(state.field, bricks)) {
      drop(state, speck, delta);
      state.work.spend(limits::speck_cost_us);
    }
  }
}

}  // namespace scree
