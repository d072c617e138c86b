// Bullet's dispatcher of pairs whose bounds meet, on several threads: contacts are found in any order, each
// pair by one thread; manifolds, which all pairs share a pool and a list of, are made and released
// afterwards, in the order of their bodies. So the result is the same for any number of threads. Private to
// this folder.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <vector>

#include "shared/base/workers.h"

namespace scree {

class PairDispatcher final : public btCollisionDispatcher {
 public:
  /// `workers` must outlive this object. Every pair's algorithm must be a HullAlgorithm.
  PairDispatcher(btCollisionConfiguration& configuration, Workers& workers)
      : btCollisionDispatcher(&configuration), workers_(workers) {}

  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override;
  /// Sum of HullAlgorithm::overlaps() of the last call.
  size_t overlaps() const { return overlaps_; }

 private:
  Workers& workers_;
  size_t overlaps_ = 0;
  std::vector<btBroadphasePair*> awake_;  ///< scratch memory of dispatchAllCollisionPairs()
};

}  // namespace scree
