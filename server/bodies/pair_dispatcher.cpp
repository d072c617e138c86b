#include "server/bodies/pair_dispatcher.h"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <algorithm>
#include <span>
#include <utility>

#include "server/bodies/hull_algorithm.h"
#include "server/bodies/limits.h"

namespace scree {

namespace {

btCollisionObject* first_of(const btBroadphasePair& pair) {
  return static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
}
btCollisionObject* second_of(const btBroadphasePair& pair) {
  return static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
}

/// Calls use(first body, second body, the pair's algorithm).
template <typename F>
void with_bodies(const btBroadphasePair& pair, F&& use) {
  const btCollisionObject *a = first_of(pair), *b = second_of(pair);
  const btCollisionObjectWrapper of_a(nullptr, a->getCollisionShape(), a, a->getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper of_b(nullptr, b->getCollisionShape(), b, b->getWorldTransform(), -1, -1);
  use(of_a, of_b, static_cast<HullAlgorithm*>(pair.m_algorithm));
}

/// Bullet's order of pairs, the newest bodies first.
bool comes_before(const btBroadphasePair* a, const btBroadphasePair* b) {
  const auto key = [](const btBroadphasePair* pair) {
    return std::pair(pair->m_pProxy0->m_uniqueId, pair->m_pProxy1->m_uniqueId);
  };
  return key(a) > key(b);
}

}  // namespace

void PairDispatcher::list(btOverlappingPairCache& pairs) {
  btBroadphasePairArray& all = pairs.getOverlappingPairArray();
  awake_.clear();
  for (int i = 0; i < all.size(); ++i) {
    btBroadphasePair& pair = all[i];
    if (!needsCollision(first_of(pair), second_of(pair))) continue;
    if (pair.m_algorithm == nullptr)
      with_bodies(pair, [&](const auto& a, const auto& b, HullAlgorithm* /*none*/) {
        pair.m_algorithm = findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
      });
    awake_.push_back(&pair);
  }
}

void PairDispatcher::search(WorkBatch& batch, float step_s) {
  // Those that overlapped in the last step share this one's room by turns.
  const auto turns = static_cast<uint32_t>(1 + overlaps_ / limits::overlaps_a_step);
  ++step_;
  const auto is_in_turn = [turns, step = step_](const btBroadphasePair& pair) {
    const auto number = static_cast<uint32_t>(pair.m_pProxy0->m_uniqueId + pair.m_pProxy1->m_uniqueId);
    return (number + step) % turns == 0;
  };
  overlaps_ = 0;
  fast_.clear();
  batch.share(std::span(awake_), limits::pairs_per_part, [=, this](std::span<btBroadphasePair*> some) {
    size_t overlaps = 0;
    for (btBroadphasePair*& pair : some)
      with_bodies(*pair, [&](const auto& a, const auto& b, HullAlgorithm* algorithm) {
        algorithm->find(a, b, step_s, is_in_turn(*pair));
        overlaps += algorithm->overlaps();
        if (algorithm->fast_touch()) {
          const std::scoped_lock lock(mutex_);
          fast_.push_back(*algorithm->fast_touch());
        }
        if (!algorithm->manifold_outdated()) pair = nullptr;
      });
    overlaps_ += overlaps;
  });
}

void PairDispatcher::update_manifolds() {
  std::erase(awake_, nullptr);
  std::ranges::sort(awake_, comes_before);
  for (const btBroadphasePair* pair : awake_)
    with_bodies(*pair, [](const auto& a, const auto& b, HullAlgorithm* algorithm) {
      algorithm->update_manifold(a, b);
    });
}

}  // namespace scree
