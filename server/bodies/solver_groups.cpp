#include "server/bodies/solver_groups.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <algorithm>
#include <numeric>

#include "server/bodies/joint_rows.h"
#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A kinematic body counts: the solver takes its speed, and one thread at a time.
bool can_move(const btCollisionObject* body) {
  return body != nullptr && !body->isStaticObject();
}

uint32_t place_of(const btCollisionObject* body) {
  return static_cast<uint32_t>(body->getCompanionId());
}

/// Moves `items` to `sorted` by their groups, those of one group in their order, and returns each group's.
/// `group_of`: by the item's number.
template <typename Item, typename GroupOf>
std::vector<std::span<Item>> sort_by_group(const std::vector<Item>& items, uint32_t groups,
                                           const GroupOf& group_of, std::vector<Item>& sorted) {
  std::vector<uint32_t> counts(groups), next(groups);
  for (size_t i = 0; i < items.size(); ++i) ++counts[group_of(i)];
  std::exclusive_scan(counts.begin(), counts.end(), next.begin(), 0U);
  sorted.resize(items.size());
  std::vector<std::span<Item>> of_groups;
  for (uint32_t group = 0; group < groups; ++group)
    of_groups.push_back(std::span(sorted).subspan(next[group], counts[group]));
  for (size_t i = 0; i < items.size(); ++i) sorted[next[group_of(i)]++] = items[i];
  return of_groups;
}

size_t cost_of(const SolverGroups::Group& group) {
  return group.bodies.size() + limits::bodies_per_manifold * (group.contacts.size() + group.joints.size());
}

}  // namespace

void SolverGroups::clear() {
  bodies_.clear();
  contacts_.clear();
  joints_.clear();
  groups_.clear();
}

void SolverGroups::add(btCollisionObject& body) {
  CHECK_DEBUG(can_move(&body));
  body.setCompanionId(static_cast<int>(bodies_.size()));
  bodies_.push_back(&body);
}

std::span<SolverGroups::Group> SolverGroups::divide() {
  join();
  const uint32_t groups = number_groups();
  const auto bodies = sort_by_group(
      bodies_, groups, [&](size_t i) { return group_of_[i]; }, grouped_bodies_);
  const auto contacts = sort_by_group(
      contacts_, groups, [&](size_t i) { return group_of_[body_of_[i]]; }, grouped_contacts_);
  const auto joints = sort_by_group(
      joints_, groups, [&](size_t i) { return group_of_[held_by_[i]]; }, grouped_joints_);
  groups_.clear();
  for (uint32_t group = 0; group < groups; ++group)
    groups_.push_back({bodies[group], contacts[group], joints[group]});
  std::ranges::stable_sort(groups_, [](const Group& a, const Group& b) { return cost_of(a) > cost_of(b); });
  return groups_;
}

uint32_t SolverGroups::join(const btCollisionObject* a, const btCollisionObject* b) {
  const uint32_t body = place_of(can_move(a) ? a : b);
  CHECK_DEBUG(body < bodies_.size());
  if (can_move(a) && can_move(b)) joined_.join(body, place_of(b));
  return body;
}

void SolverGroups::join() {
  joined_.reset(bodies_.size());
  body_of_.clear();
  held_by_.clear();
  for (const Contacts& contacts : contacts_)
    body_of_.push_back(join(contacts.manifold->getBody0(), contacts.manifold->getBody1()));
  for (const JointRows* joint : joints_) held_by_.push_back(join(joint->body_a(), joint->body_b()));
}

uint32_t SolverGroups::number_groups() {
  costs_.assign(bodies_.size(), 0);
  for (uint32_t body = 0; body < bodies_.size(); ++body) ++costs_[joined_.root_of(body)];
  for (const uint32_t body : body_of_) costs_[joined_.root_of(body)] += limits::bodies_per_manifold;
  for (const uint32_t body : held_by_) costs_[joined_.root_of(body)] += limits::bodies_per_manifold;
  group_of_.resize(bodies_.size());
  uint32_t groups = 0, cost = limits::solver_group_cost;
  for (uint32_t body = 0; body < bodies_.size(); ++body) {
    const uint32_t root = joined_.root_of(body);
    if (root == body && cost >= limits::solver_group_cost) ++groups, cost = 0;
    if (root == body) cost += costs_[body];
    group_of_[body] = root == body ? groups - 1 : group_of_[root];  // the root comes first
  }
  return groups;
}

}  // namespace scree
