#include "server/world/island_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/limits.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/falling/island.h"
#include "shared/falling/overload.h"
#include "shared/recombine/specks.h"

namespace scree {

namespace {

/// Whether the island is still there: an earlier island of this tick may have been the same.
bool still_there(Field& field, const Island& island) {
  const VoxelCoord v = island.start;
  return field.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
}

/// A post that was cut off stands on a foot that is small for its height. Nothing in the world is as quiet as
/// that: it sets out to topple, with a few times the energy that lifts it over the edge of its foot, to a
/// side that its place says. Nothing for other islands.
BodyState toppling(const VoxelBox& box, float voxel_size_m) {
  BodyState body;
  const glm::vec3 size = glm::vec3(box.size().x, box.size().y, box.size().z) * voxel_size_m;
  const float width = std::max(size.x, size.z);
  if (size.y < limits::post_slenderness * width) return body;
  const uint64_t place = mixed_bits(box.lo);
  const auto part = [](uint64_t bits) { return static_cast<float>(bits & 0xFFU) / 127.5F - 1.0F; };
  const glm::vec2 wanted(part(place) + 0.002F, part(place >> 8U));
  const glm::vec2 side = wanted / std::sqrt(glm::dot(wanted, wanted));
  const float arm = 0.5F * size.y;
  const float speed = width / std::sqrt(arm / standard_gravity);
  body.velocity_m_s = speed * glm::vec3(side.x, 0.0F, side.y);
  body.spin_rad_s = speed / arm * glm::vec3(side.y, 0.0F, -side.x);
  return body;
}

void drop(World::State& state, const Island& island, uint64_t party, TickDelta& delta) {
  if (!still_there(state.field, island)) return;
  const Applied applied =
      state.apply_and_record(IslandOperation{island.box, island.start, state.next_piece}, party, delta);
  state.enter_removed(applied);
  state.islands.fell(applied.changed);
  const float dx = state.config.terrain.voxel_size_m;
  const auto at_rest = [&](PieceId, const Volume& volume) {
    Newborn born;
    if (state.config.rules >= rules::joints) born.body = toppling(island.box, dx);
    born.body.pose.position_m = volume.centre_voxels * dx;
    born.may_be_concave = true;
    born.traits.fell = true;
    born.traits.owner = party;
    return born;
  };
  spawn(state, applied, at_rest, delta);
}

constexpr SearchLimits limits_with(const Holding* holding) {
  return {
      .parts_max = limits::island_parts_max,
      .bricks_per_chunk = static_cast<size_t>(limits::ground_chunk_cost_us / limits::island_brick_cost_us),
      .holding = holding};
}

bool has_seen(const IslandSearch& search, std::span<const BrickCoord> bricks) {
  return std::ranges::any_of(bricks, [&](BrickCoord brick) { return search.visited(brick); });
}

bool meet(const VoxelBox& a, const VoxelBox& b) {
  return !common(a, b).empty();
}

/// Whether a brick holds a voxel of an island's box, or one beside it.
bool touches_one(std::span<const Island> islands, std::span<const BrickCoord> bricks) {
  return std::ranges::any_of(islands, [&](const Island& island) {
    const VoxelBox around = island.box.grown(1);
    return std::ranges::any_of(bricks, [&](BrickCoord brick) {
      const VoxelCoord lo = first_voxel(brick);
      return meet(around, {lo, lo + VoxelCoord{brick_size, brick_size, brick_size}});
    });
  });
}

/// What the tick has room for, within bounds.
size_t bricks_to_read(const WorkBudget& work) {
  const float paid = std::max(work.left_us(), 0.0F) / limits::island_brick_cost_us;
  return std::clamp(static_cast<size_t>(paid), limits::island_bricks_per_tick_min,
                    limits::island_bricks_per_tick_max);
}

/// Adds one search for each party's cuts of this tick; or several, when the cuts of many ticks waited for
/// Methods::islands: a search over all of them would restart with every change among them.
void begin_searches(World::State& state) {
  for (const auto& [party, bricks] : state.loosened_bricks) {
    std::vector<BrickCoord> part;
    for (const BrickCoord brick : bricks) {
      part.push_back(brick);
      if (part.size() == limits::island_loosened_bricks_max)
        state.islands.push(party, std::exchange(part, {}));
    }
    state.islands.push(party, std::move(part));
  }
  state.loosened_bricks.clear();
}

/// Whether the party's terrain may become one more piece now.
bool may_fall(const World::State& state, uint64_t party) {
  const PieceRoom room{.alive = state.pieces.size(),
                       .pieces_max = state.config.pieces_max,
                       .bodies_load = state.work.bodies_load(),
                       .others_wait = state.requests.others_wait(party) || state.islands.others_wait(party)};
  const PieceGrant grant = state.shares.grant(party, 1, room);
  return grant.pieces > 0 || grant.pieces_at_last > 0;
}

}  // namespace

void IslandQueue::push(uint64_t party, std::vector<BrickCoord> loosened, std::vector<VoxelBox> hung) {
  if (!loosened.empty()) waiting_.push(party, {std::move(loosened), nullptr, 0, 0.0F, std::move(hung)});
}

void IslandQueue::begin_tick() {
  waiting_.begin_tick();
  falling_.begin_tick();
}

std::vector<BrickCoord> IslandQueue::Falling::starts() const {
  std::vector<BrickCoord> starts;
  for (const Island& island : islands) starts.push_back(brick_of(island.start));
  return starts;
}

std::vector<VoxelBox> IslandQueue::Falling::boxes() const {
  std::vector<VoxelBox> boxes;
  for (const Island& island : islands) boxes.push_back(island.box);
  return boxes;
}

IslandQueue::Backlog IslandQueue::backlog(uint64_t party) const {
  Backlog backlog;
  if (const auto line = waiting_.lines().find(party); line != waiting_.lines().end())
    backlog.searches = line->second.items.size();
  if (const auto line = falling_.lines().find(party); line != falling_.lines().end())
    for (const Falling& falling : line->second.items) backlog.falls += falling.islands.size();
  return backlog;
}

size_t IslandQueue::parties() const {
  return waiting_.lines().size() +
         static_cast<size_t>(std::ranges::count_if(
             falling_.lines(), [this](const auto& line) { return !waiting_.waits(line.first); }));
}

bool IslandQueue::others_wait(uint64_t party) const {
  return waiting_.others_wait(party) || falling_.others_wait(party);
}

std::vector<LooseningEdit> IslandQueue::value() const {
  std::map<uint64_t, std::vector<LooseningEdit>> parties;
  for (const auto& [party, line] : falling_.lines())
    for (const Falling& falling : line.items) parties[party].push_back({falling.starts(), 0, party});
  for (const auto& [party, line] : waiting_.lines())
    for (const Waiting& waiting : line.items)
      parties[party].push_back({waiting.loosened, waiting.restarts, party});
  std::vector<LooseningEdit> value;
  for (auto& [party, searches] : parties) std::ranges::move(searches, std::back_inserter(value));
  return value;
}

void IslandQueue::restore(const std::vector<LooseningEdit>& value) {
  *this = IslandQueue();
  for (const LooseningEdit& edit : value)
    if (!edit.bricks.empty()) waiting_.push(edit.party, {edit.bricks, nullptr, edit.restarts});
}

std::vector<BrickCoord> IslandQueue::waiting() const {
  std::vector<BrickCoord> bricks;
  for (const auto& [party, line] : waiting_.lines())
    for (const Waiting& waiting : line.items)
      bricks.insert(bricks.end(), waiting.loosened.begin(), waiting.loosened.end());
  return bricks;
}

void IslandQueue::fell(std::span<const BrickCoord> bricks) {
  for (auto& [party, line] : waiting_.lines())
    for (Waiting& waiting : line.items) {
      if (waiting.search == nullptr || !has_seen(*waiting.search, bricks)) continue;
      waiting.search.reset();
      ++waiting.restarts;
    }
}

void IslandQueue::changed(std::span<const BrickCoord> bricks, uint32_t rules) {
  fell(bricks);
  for (auto& [party, line] : falling_.lines())
    for (Falling& falling : line.items) {
      falling.stale = has_seen(*falling.search, bricks) &&
                      (rules < rules::joints || touches_one(falling.islands, bricks));
      if (falling.stale) push(party, falling.starts(), falling.boxes());
    }
  falling_.erase_if([](const Falling& falling) { return falling.stale; });
}

bool IslandQueue::is_known(uint64_t party, std::span<const BrickCoord> loosened) const {
  const auto line = falling_.lines().find(party);
  return line != falling_.lines().end() &&
         std::ranges::any_of(line->second.items,
                             [&](const Falling& falling) { return falling.search->knows(loosened); });
}

bool IslandQueue::search(Field& field, SearchAllowance& allowance, uint32_t rules, const Holding* holding) {
  if (waiting_.empty() || allowance.bricks == 0) return false;
  const uint64_t party = waiting_.whose();
  Waiting& first = waiting_.next();
  if (rules >= rules::joints && first.search == nullptr && is_known(party, first.loosened)) {
    waiting_.pop(0.0F);
    return true;
  }
  const size_t read_before = allowance.read;
  if (first.search == nullptr) {
    first.search = std::make_unique<IslandSearch>(field, first.loosened, limits_with(holding));
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
  const float charged_us = limits::island_brick_cost_us * static_cast<float>(allowance.read - read_before);
  if (!finished) {
    waiting_.go_on(charged_us, 0.0F);
    return false;
  }
  Falling falling{first.search->islands(), std::move(first.search)};
  waiting_.pop(charged_us);
  allowance.too_large += static_cast<uint32_t>(falling.search->too_large());
  // From the ground up, so that none falls on one that waits.
  std::ranges::sort(falling.islands, std::ranges::greater{},
                    [](const Island& island) { return std::pair(island.box.lo.y, island.start); });
  if (falling.islands.empty()) return true;
  falling.cost_us = lift_price_us(falling.islands.back().box);
  falling_.push(party, std::move(falling));
  return true;
}

void IslandQueue::pop(float charged_us) {
  CHECK(!falling_.empty() && !falling_.next().islands.empty());
  std::vector<Island>& islands = falling_.next().islands;
  islands.pop_back();
  if (islands.empty())
    falling_.pop(charged_us);
  else
    falling_.go_on(charged_us, lift_price_us(islands.back().box));
}

size_t IslandQueue::falling() const {
  size_t count = 0;
  for (const auto& [party, line] : falling_.lines())
    for (const Falling& falling : line.items) count += falling.islands.size();
  return count;
}

bool IslandQueue::hangs_at(const VoxelBox& box) const {
  const auto touches = [&](const VoxelBox& island) { return meet(island.grown(1), box); };
  for (const auto& [party, line] : falling_.lines())
    for (const Falling& falling : line.items)
      if (std::ranges::any_of(falling.islands, touches, &Island::box)) return true;
  for (const auto& [party, line] : waiting_.lines())
    for (const Waiting& waiting : line.items)
      if (std::ranges::any_of(waiting.hung, touches)) return true;
  return false;
}

Result<void> may_cause_falls(const World::State& state, uint64_t party) {
  party = state.charged(party);
  if (party == 0 || !state.config.methods.islands || state.islands.idle(party)) return {};
  const IslandQueue::Backlog own = state.islands.backlog(party);
  const size_t left = limits::falls_waiting_max - std::min(limits::falls_waiting_max, state.islands.size());
  const size_t parties = state.islands.parties();
  const std::string count = std::to_string(own.count()) +
                            " falls that this client, or those who share with "
                            "it, caused are waiting";
  if (own.count() >= std::max(left, limits::falls_waiting_max / parties))
    return fail(count + ", and others' leave no room for more of " +
                std::to_string(limits::falls_waiting_max) + " (limits.falls_waiting_max): ask again later");
  // Where they do not fit, one falls in island_rest_s, by the parties' turns.
  const float wait_s = limits::island_rest_s * static_cast<float>(own.falls) * static_cast<float>(parties);
  if (wait_s <= limits::falls_wait_max_s) return {};
  return fail(count + ", for about " + std::to_string(static_cast<int>(std::lround(wait_s))) +
              " s; this server lets them wait for " +
              std::to_string(static_cast<int>(limits::falls_wait_max_s)) +
              " s (limits.falls_wait_max_s): ask again when some have fallen");
}

namespace {

/// Islands fall by the parties' turns while they fit. Where the next one does not, those of others may, and
/// now and then it falls all the same; that is charged as all that could have been done meanwhile.
void fall_in_turn(World::State& state, TickDelta& delta) {
  const auto rest = static_cast<Tick>(limits::island_rest_s * static_cast<float>(state.config.tick_rate_hz));
  const float rest_us = limits::island_rest_s * client_us_per_s(state.work, state.config);
  bool in_order = true;
  while (const Island* next = state.islands.next()) {
    const Island island = *next;
    const uint64_t party = state.islands.next_party();
    if (state.pieces.size() >= state.config.pieces_max) break;
    if (!may_fall(state, party)) {
      state.islands.pass_over();
      continue;
    }
    if (state.config.rules >= rules::joints && !still_there(state.field, island)) {
      state.islands.pop(0.0F);
      continue;
    }
    const float cost = lift_price_us(island.box);
    const bool fits = state.work.affords(cost) && !is_crowding(state, party);
    const Tick wait = wait_for_room(state, party, cost, rest);
    if (!fits && (!in_order || state.tick - state.island_at < wait)) {
      in_order = false;
      state.islands.pass_over();
      continue;
    }
    if (in_order) state.island_at = state.tick;
    state.islands.pop(fits ? cost : std::max(cost, part_of(rest_us, wait, rest)));
    drop(state, island, party, delta);
    state.work.spend(cost);
  }
}

}  // namespace

void drop_islands(World::State& state, TickDelta& delta) {
  const std::vector<BrickCoord> changed(state.changed.begin(), state.changed.end());
  state.islands.changed(changed, state.config.rules);
  if (!state.config.methods.islands) return;
  begin_searches(state);
  state.islands.begin_tick();
  SearchAllowance allowance{.bricks = bricks_to_read(state.work)};
  while (state.islands.search(state.field, allowance, state.config.rules, state.regions.holding())) {
  }
  state.regions.remember_held();
  delta.work.islands_too_large += allowance.too_large;
  state.work.spend(limits::island_brick_cost_us * static_cast<float>(allowance.read));
  fall_in_turn(state, delta);
  delta.work.islands_put_off = static_cast<uint32_t>(state.islands.falling());
}

void sweep_specks(World::State& state, TickDelta& delta) {
  // A speck's fall may leave another speck behind: so this repeats until none is found.
  while (!state.unswept.empty()) {
    const auto unswept = std::exchange(state.unswept, {});
    for (const auto& [party, changed] : unswept) {
      const std::vector<BrickCoord> bricks(changed.begin(), changed.end());
      for (const Island& speck : find_specks(state.field, bricks)) {
        if (const Region* const region = state.regions.forbidding(forbids::falls, speck.box)) {
          state.regions.remember(region->id, brick_of(speck.start));
          continue;
        }
        drop(state, speck, party, delta);
        state.work.spend(limits::speck_cost_us);
      }
    }
  }
}

}  // namespace scree
