// Bullet's dispatcher of pairs whose bounds meet, on several threads. Contacts are found in any order, each
// pair by one thread. All pairs share a pool and a list of manifolds, so these are made and released
// afterwards, in the order of their bodies. So the result is the same for any number of threads. Private to
// this folder.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <atomic>
#include <mutex>
#include <vector>

#include "server/bodies/hull_algorithm.h"
#include "shared/base/workers.h"

namespace scree {

/// Every pair's algorithm must be a HullAlgorithm. A step is list(), what search() adds, and
/// update_manifolds().
class PairDispatcher final : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;

  /// Lists the pairs of which a body is awake, and makes their algorithms. The pairs must stay until
  /// update_manifolds().
  void list(btOverlappingPairCache& pairs);
  /// Adds the search for the contacts of the listed pairs. It reads poses and hulls.
  void search(WorkBatch& batch, float step_s);
  /// After the solver: holds the pairs that touch and were fast (hull_algorithm.h).
  void hold_fast(float step_s) const {
    for (const FastTouch& touch : fast_) touch.hold(step_s);
  }
  /// Makes and releases manifolds.
  void update_manifolds();
  /// Sum of HullAlgorithm::overlaps() of the last step.
  size_t overlaps() const { return overlaps_; }

 private:
  std::atomic<size_t> overlaps_{0};
  uint32_t step_ = 0;
  std::mutex mutex_;
  std::vector<FastTouch> fast_;  ///< of this step, in any order; guarded by mutex_ while it is searched
  std::vector<btBroadphasePair*>
      awake_;  ///< listed; after the search, those that update_manifolds() has to do with
};

}  // namespace scree
