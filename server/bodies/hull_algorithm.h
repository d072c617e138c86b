// Bullet's collision algorithm for hull against hull, by distance_between; where the hulls overlap by more
// than their margins, Bullet's own search for the depth takes over. Replaces btConvexConvexAlgorithm, which
// took two thirds of a step of 1,000 pieces.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "server/bodies/hull_distance.h"

namespace scree {

/// Both objects' user pointers must be their HullCorners, turned to their present pose.
class HullAlgorithm final : public btCollisionAlgorithm {
 public:
  using btCollisionAlgorithm::btCollisionAlgorithm;
  ~HullAlgorithm() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override;
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  void find_depth(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                  btManifoldResult& result);

  btPersistentManifold* manifold_ = nullptr;  ///< only while there are contacts
  NearestCorners nearest_;
};

struct HullAlgorithmCreator final : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override;
};

}  // namespace scree
