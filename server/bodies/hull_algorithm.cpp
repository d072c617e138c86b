#include "server/bodies/hull_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <algorithm>
#include <new>

#include "server/bodies/limits.h"

namespace scree {

namespace {

const HullCorners& corners_of(const btCollisionObjectWrapper* body) {
  return *static_cast<const HullCorners*>(body->getCollisionObject()->getUserPointer());
}

float margin_of(const btCollisionObjectWrapper* body) {
  return static_cast<const btConvexHullShape*>(body->getCollisionShape())->getMargin();
}

}  // namespace

HullAlgorithm::~HullAlgorithm() {
  if (manifold_ != nullptr) m_dispatcher->releaseManifold(manifold_);
}

void HullAlgorithm::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                     const btDispatcherInfo& /*info*/, btManifoldResult* result) {
  const btVector3& centre_b = b->getWorldTransform().getOrigin();
  const btVector3 off = a->getWorldTransform().getOrigin() - centre_b;
  const float margin_b = margin_of(b);
  const float margins = margin_of(a) + margin_b;
  const HullDistance found = distance_between(corners_of(a), corners_of(b), {off.x(), off.y(), off.z()},
                                              margins + limits::contact_slack_m, nearest_);
  const bool touching = found.kind != HullDistance::Kind::apart;
  if (manifold_ == nullptr && !touching) return;
  if (manifold_ == nullptr)
    manifold_ = m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject());
  result->setPersistentManifold(manifold_);
  if (found.kind == HullDistance::Kind::near) {
    const btVector3 normal(found.normal.x, found.normal.y, found.normal.z);
    const btVector3 on_b(found.on_b.x, found.on_b.y, found.on_b.z);
    result->addContactPoint(normal, centre_b + on_b + normal * margin_b, found.distance_m - margins);
  } else if (touching) {
    find_depth(a, b, *result);
  }
  result->refreshContactPoints();
  if (manifold_->getNumContacts() > 0) return;
  m_dispatcher->releaseManifold(manifold_);
  manifold_ = nullptr;
}

void HullAlgorithm::find_depth(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                               btManifoldResult& result) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(static_cast<const btConvexShape*>(a->getCollisionShape()),
                             static_cast<const btConvexShape*>(b->getCollisionShape()), &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a->getWorldTransform();
  input.m_transformB = b->getWorldTransform();
  detector.getClosestPoints(input, result, nullptr);
}

/// No continuous collision: speeds are limited instead.
btScalar HullAlgorithm::calculateTimeOfImpact(btCollisionObject* /*a*/, btCollisionObject* /*b*/,
                                              const btDispatcherInfo& /*info*/,
                                              btManifoldResult* /*result*/) {
  return btScalar(1.0);
}

void HullAlgorithm::getAllContactManifolds(btManifoldArray& manifolds) {
  if (manifold_ != nullptr) manifolds.push_back(manifold_);
}

btCollisionAlgorithm* HullAlgorithmCreator::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* /*a*/,
    const btCollisionObjectWrapper* /*b*/) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(HullAlgorithm))) HullAlgorithm(info);
}

}  // namespace scree
