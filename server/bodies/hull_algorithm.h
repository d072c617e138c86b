// Bullet's collision algorithm for hull against hull, by distance_between; where the hulls overlap by more
// than their margins, Bullet's own search for the depth takes over. Replaces btConvexConvexAlgorithm, which
// took two thirds of a step of 1,000 pieces.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <glm/mat3x3.hpp>
#include <vector>

#include "server/bodies/hull_distance.h"

namespace scree {

/// What of a body touches other bodies: one hull, or several of a concave piece.
class CollisionHulls {
 public:
  struct Part {
    const btConvexHullShape* shape;  ///< in the body's frame
    HullCorners corners;             ///< of it, turned
    glm::vec3 middle_m;              ///< of a sphere about it, in the body's axes
    glm::vec3 turned_m;              ///< the same, turned
    float reach_m;                   ///< that sphere's radius, with the margin
  };

  /// The shape must outlive this.
  void add(const btConvexHullShape& shape);
  void turn(const glm::mat3& rotation);
  const std::vector<Part>& parts() const { return parts_; }

 private:
  std::vector<Part> parts_;
};

/// Both objects' user pointers must be their CollisionHulls, turned to their present pose.
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
  struct Meeting;
  void meet(const Meeting& meeting, NearestCorners& nearest, btManifoldResult& result);

  btPersistentManifold* manifold_ = nullptr;  ///< only while there are contacts
  NearestCorners nearest_;                    ///< of the first parts
  std::vector<NearestCorners> of_others_;     ///< of all other pairs of parts, if there are any
};

struct HullAlgorithmCreator final : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override;
};

}  // namespace scree
