#include "server/world/support_stage.h"

#include <algorithm>
#include <utility>

#include "server/work/limits.h"
#include "server/world/limits.h"
#include "server/world/neck.h"
#include "server/world/rules.h"
#include "shared/base/check.h"
#include "shared/falling/spans.h"
#include "shared/falling/support_search.h"

namespace scree {

namespace {

/// The first waiting brick, and those near it.
std::vector<BrickCoord> first_cluster(const std::set<BrickCoord>& strained) {
  CHECK(!strained.empty());
  const BrickCoord first = *strained.begin();
  const auto near = [](int a, int b) { return std::abs(a - b) < limits::support_cluster_bricks; };
  std::vector<BrickCoord> cluster;
  for (const BrickCoord brick : strained) {
    if (!near(brick.x, first.x)) break;  // they are ordered by x
    if (near(brick.y, first.y) && near(brick.z, first.z)) cluster.push_back(brick);
  }
  return cluster;
}

/// Where nothing is too heavy for its neck and nothing is a lever: whether a span between supports breaks.
void add_spans(World::State& state, std::span<const BrickCoord> cluster, SupportFound& found) {
  if (state.config.rules < rules::spans || !found.overloads.empty()) return;
  SpansFound spans = find_spans(state.field, *state.palette, cluster, state.regions.holding());
  state.work.spend(limits::span_brick_cost_us * static_cast<float>(spans.bricks_read) +
                   limits::span_joint_cost_us * static_cast<float>(spans.joints) +
                   limits::span_product_cost_us * static_cast<float>(spans.products));
  found.overloads = std::move(spans.overloads);
}

/// Searches the party's first cluster, and breaks off what is too heavy. Whether anything was.
bool search_cluster(World::State& state, uint64_t party, TickDelta& delta) {
  std::set<BrickCoord>& strained = state.strained.at(party);
  const std::vector<BrickCoord> cluster = first_cluster(strained);
  for (const BrickCoord brick : cluster) strained.erase(brick);
  SupportFound found = find_overloads(state.field, *state.palette, cluster, limits::support_reach_bricks,
                                      state.regions.holding());
  state.work.spend(limits::support_part_cost_us * static_cast<float>(found.parts));
  delta.work.supports_given_up += found.given_up ? 1 : 0;
  add_spans(state, cluster, found);
  state.regions.remember_held(cluster);
  bool room = true;
  for (const Overload& overload : found.overloads) {
    if (const Region* const region = region_of_necks(state, overload)) {
      for (const BrickCoord brick : cluster) state.regions.remember(region->id, brick);
      continue;
    }
    room = room && crush_necks(state, overload, party, nullptr, delta);
  }
  if (!room) state.strained[party].insert(cluster.begin(), cluster.end());
  return !found.overloads.empty();
}

}  // namespace

void break_overloads(World::State& state, TickDelta& delta) {
  if (!state.config.methods.support || !state.config.methods.islands) state.strained.clear();
  TurnQueue<WaitingWork>& turns = state.turns.supports;
  for (const auto& [party, bricks] : state.strained) turns.push(party, {});
  turns.begin_tick();
  std::set<uint64_t> broken;  // the islands of a break fall before the party's next search
  bool first = true;
  while (!turns.empty()) {
    const uint64_t party = turns.whose();
    if (broken.contains(party) || !state.islands.idle(party)) {
      turns.pass_over();
      continue;
    }
    if (!std::exchange(first, false) && !state.work.affords(0.0F)) break;
    const float left_us = state.work.left_us();
    if (search_cluster(state, party, delta)) broken.insert(party);
    const float spent_us = left_us - state.work.left_us();
    const auto strained = state.strained.find(party);
    if (!strained->second.empty()) {
      turns.go_on(spent_us, 0.0F);
      continue;
    }
    state.strained.erase(strained);
    turns.pop(spent_us);
  }
  turns.clear();
  for (const auto& [party, bricks] : state.strained)
    delta.work.supports_put_off += static_cast<uint32_t>(bricks.size());
}

}  // namespace scree
