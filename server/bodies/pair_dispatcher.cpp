#include "server/bodies/pair_dispatcher.h"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <span>

#include "server/bodies/hull_algorithm.h"
#include "server/bodies/limits.h"

namespace scree {

namespace {

/// Calls use(first body, second body, the pair's algorithm).
template <typename F>
void with_bodies(const btBroadphasePair& pair, F&& use) {
  const auto* a = static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject);
  const auto* b = static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
  const btCollisionObjectWrapper of_a(nullptr, a->getCollisionShape(), a, a->getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper of_b(nullptr, b->getCollisionShape(), b, b->getWorldTransform(), -1, -1);
  use(of_a, of_b, static_cast<HullAlgorithm*>(pair.m_algorithm));
}

/// Lists the pairs of which a body is awake, and gives each its algorithm, in Bullet's order.
struct AwakePairs final : btOverlapCallback {
  AwakePairs(PairDispatcher& to, std::vector<btBroadphasePair*>& list) : dispatcher(to), pairs(list) {}
  bool processOverlap(btBroadphasePair& pair) override {
    if (!dispatcher.needsCollision(static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject),
                                   static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject)))
      return false;
    if (pair.m_algorithm == nullptr)
      with_bodies(pair, [&](const auto& a, const auto& b, HullAlgorithm* /*none*/) {
        pair.m_algorithm = dispatcher.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
      });
    pairs.push_back(&pair);
    return false;
  }

  PairDispatcher& dispatcher;
  std::vector<btBroadphasePair*>& pairs;
};

}  // namespace

void PairDispatcher::dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                               btDispatcher* dispatcher) {
  awake_.clear();
  AwakePairs awake(*this, awake_);
  pairs->processAllOverlappingPairs(&awake, dispatcher, info);
  workers_.share(std::span(awake_), limits::pairs_per_part, [&](size_t, std::span<btBroadphasePair*> some) {
    for (const btBroadphasePair* pair : some)
      with_bodies(*pair, [&](const auto& a, const auto& b, HullAlgorithm* algorithm) {
        algorithm->find(a, b, info.m_timeStep);
      });
  });
  for (const btBroadphasePair* pair : awake_)
    if (static_cast<HullAlgorithm*>(pair->m_algorithm)->must_keep())
      with_bodies(*pair,
                  [&](const auto& a, const auto& b, HullAlgorithm* algorithm) { algorithm->keep(a, b); });
}

}  // namespace scree
