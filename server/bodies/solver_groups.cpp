#include "server/bodies/solver_groups.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <algorithm>
#include <numeric>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

bool can_move(const btCollisionObject* body) {
  return !body->isStaticOrKinematicObject();
}

uint32_t place_of(const btCollisionObject* body) {
  return static_cast<uint32_t>(body->getCompanionId());
}

/// Moves `items` to `sorted` by their groups, those of one group in their order, and returns each group's.
template <typename Item, typename GroupOf>
std::vector<std::span<Item>> sort_by_group(const std::vector<Item>& items, uint32_t groups,
                                           const GroupOf& group_of, std::vector<Item>& sorted) {
  std::vector<uint32_t> counts(groups), next(groups);
  for (const Item& item : items) ++counts[group_of(item)];
  std::exclusive_scan(counts.begin(), counts.end(), next.begin(), 0U);
  sorted.resize(items.size());
  std::vector<std::span<Item>> of_groups;
  for (uint32_t group = 0; group < groups; ++group)
    of_groups.push_back(std::span(sorted).subspan(next[group], counts[group]));
  for (const Item& item : items) sorted[next[group_of(item)]++] = item;
  return of_groups;
}

size_t cost_of(const SolverGroups::Group& group) {
  return group.bodies.size() + limits::bodies_per_manifold * group.manifolds.size();
}

}  // namespace

void SolverGroups::clear() {
  bodies_.clear();
  manifolds_.clear();
  groups_.clear();
}

void SolverGroups::processIsland(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                 int manifold_count, int /*island*/) {
  bodies_.insert(bodies_.end(), bodies, bodies + body_count);
  manifolds_.insert(manifolds_.end(), manifolds, manifolds + manifold_count);
}

std::span<SolverGroups::Group> SolverGroups::divide() {
  join();
  const uint32_t groups = number_groups();
  const auto bodies = sort_by_group(
      bodies_, groups, [&](const btCollisionObject* body) { return group_of_[place_of(body)]; },
      grouped_bodies_);
  const auto manifolds = sort_by_group(
      manifolds_, groups, [&](const btPersistentManifold* manifold) { return group_of(*manifold); },
      grouped_manifolds_);
  groups_.clear();
  for (uint32_t group = 0; group < groups; ++group) groups_.push_back({bodies[group], manifolds[group]});
  std::ranges::stable_sort(groups_, [](const Group& a, const Group& b) { return cost_of(a) > cost_of(b); });
  return groups_;
}

uint32_t SolverGroups::root_of(uint32_t body) {
  while (parents_[body] != body) body = parents_[body] = parents_[parents_[body]];
  return body;
}

void SolverGroups::join() {
  parents_.resize(bodies_.size());
  std::iota(parents_.begin(), parents_.end(), 0U);
  for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->setCompanionId(static_cast<int>(i));
  for (const btPersistentManifold* manifold : manifolds_) {
    if (!can_move(manifold->getBody0()) || !can_move(manifold->getBody1())) continue;
    const uint32_t a = root_of(place_of(manifold->getBody0())), b = root_of(place_of(manifold->getBody1()));
    parents_[std::max(a, b)] = std::min(a, b);
  }
}

uint32_t SolverGroups::group_of(const btPersistentManifold& manifold) const {
  const btCollisionObject* first = manifold.getBody0();
  return group_of_[place_of(can_move(first) ? first : manifold.getBody1())];
}

uint32_t SolverGroups::number_groups() {
  costs_.assign(bodies_.size(), 0);
  for (uint32_t body = 0; body < bodies_.size(); ++body) ++costs_[root_of(body)];
  for (const btPersistentManifold* manifold : manifolds_) {
    const btCollisionObject* first = manifold->getBody0();
    const uint32_t body = place_of(can_move(first) ? first : manifold->getBody1());
    CHECK_DEBUG(body < bodies_.size());
    costs_[root_of(body)] += limits::bodies_per_manifold;
  }
  group_of_.resize(bodies_.size());
  uint32_t groups = 0, cost = limits::solver_group_cost;
  for (uint32_t body = 0; body < bodies_.size(); ++body) {
    const uint32_t root = root_of(body);
    if (root == body && cost >= limits::solver_group_cost) ++groups, cost = 0;
    if (root == body) cost += costs_[body];
    group_of_[body] = root == body ? groups - 1 : group_of_[root];  // the root comes first
  }
  return groups;
}

}  // namespace scree
