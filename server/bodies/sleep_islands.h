// Which bodies sleep: those of an island, bodies whose bounds meet or that joints hold, fall asleep and wake
// together. Bullet's rule; its own manager sorts what our solver has in order already. Private to this
// folder.
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <cstdint>
#include <span>
#include <vector>

#include "server/bodies/disjoint_sets.h"

namespace scree {

class JointRows;

class SleepIslands {
 public:
  /// Finds the islands, and lets those sleep in which no body is active; wakes all bodies of the others. Sets
  /// the bodies' island tags: their place in `bodies`, and -1 for a static one.
  void update(const btCollisionObjectArray& bodies, btOverlappingPairCache& pairs,
              std::span<JointRows* const> joints);
  /// Whether the body, which is not static, was in an island that is awake when update() looked.
  bool is_awake(const btCollisionObject& body) const {
    return awake_[static_cast<size_t>(body.getIslandTag())] != 0;
  }

 private:
  DisjointSets islands_;
  std::vector<char> awake_;  ///< of each body, as its island
};

}  // namespace scree
