#include "server/bodies/hull_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>

#include "server/bodies/body_shape.h"
#include "server/bodies/limits.h"
#include "server/bodies/to_bullet.h"
#include "server/bodies/told_overlap.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

const CollisionHulls& hulls_of(const btCollisionObjectWrapper& body) {
  CHECK_DEBUG(body.getCollisionObject()->getUserPointer() != nullptr);
  return *static_cast<const CollisionHulls*>(body.getCollisionObject()->getUserPointer());
}

// Bullet's globals that this reads are constants and callbacks that nobody sets: threads may be here at once.
void find_depth(const btConvexHullShape& a, const btTransform& at_a, const btConvexHullShape& b,
                const btTransform& at_b, btDiscreteCollisionDetectorInterface::Result& result) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(&a, &b, &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = at_a;
  input.m_transformB = at_b;
  detector.getClosestPoints(input, result, nullptr);
}

}  // namespace

/// A pair of parts of two bodies.
struct HullAlgorithm::Meeting {
  const btCollisionObjectWrapper& object_a;
  const btCollisionObjectWrapper& object_b;
  const CollisionHulls::Part& a;
  const CollisionHulls::Part& b;
  glm::vec3 a_from_b;  ///< centre of body a relative to that of body b

  bool is_far() const {
    const glm::vec3 off = a_from_b + a.turned_m - b.turned_m;
    const float reach = a.reach_m + b.reach_m + limits::contact_slack_m;
    return off.x * off.x + off.y * off.y + off.z * off.z > reach * reach;
  }
};

struct HullAlgorithm::ContactSink final : btDiscreteCollisionDetectorInterface::Result {
  ContactSink(btManifoldResult* to, std::vector<Contact>& without, float told)
      : result(to), first(without), told_m(told) {}
  void setShapeIdentifiersA(int /*part*/, int /*index*/) override {}
  void setShapeIdentifiersB(int /*part*/, int /*index*/) override {}
  void addContactPoint(const btVector3& normal_on_b, const btVector3& on_b, btScalar distance) override {
    const float shallower_m = std::max(distance, -told_m);
    if (result != nullptr)
      result->addContactPoint(normal_on_b, on_b, shallower_m);
    else
      first.push_back({normal_on_b, on_b, shallower_m});
  }

  btManifoldResult* result;  ///< null: there is no manifold yet
  std::vector<Contact>& first;
  float told_m;
};

void CollisionHulls::add(const btConvexHullShape& shape) {
  const std::vector<glm::vec3> corners = corners_of(shape);
  glm::vec3 lo(1e30F), hi(-1e30F);
  for (const glm::vec3& p : corners) lo = glm::min(lo, p), hi = glm::max(hi, p);
  const glm::vec3 middle = 0.5F * (lo + hi);
  float reach2 = 0.0F;
  for (const glm::vec3& p : corners) reach2 = std::max(reach2, glm::dot(p - middle, p - middle));
  parts_.push_back({&shape, HullCorners(corners), middle, middle, std::sqrt(reach2) + shape.getMargin()});
}

void CollisionHulls::turn(const glm::mat3& rotation) {
  for (Part& part : parts_) {
    part.corners.turn(rotation);
    part.turned_m = rotation * part.middle_m;
  }
}

HullAlgorithm::~HullAlgorithm() {
  if (manifold_ != nullptr) m_dispatcher->releaseManifold(manifold_);
}

void HullAlgorithm::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                     const btDispatcherInfo& info, btManifoldResult* /*result*/) {
  find(*a, *b, info.m_timeStep);
  if (manifold_outdated()) update_manifold(*a, *b);
}

void HullAlgorithm::find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, float step_s) {
  const glm::vec3 a_from_b =
      from_bullet(a.getWorldTransform().getOrigin() - b.getWorldTransform().getOrigin());
  const auto &parts_a = hulls_of(a).parts(), &parts_b = hulls_of(b).parts();
  const size_t pairs = parts_a.size() * parts_b.size();
  CHECK_DEBUG(pairs > 0);
  if (of_others_.size() + 1 != pairs) of_others_.resize(pairs - 1);
  first_.clear();
  overlaps_ = 0;
  btManifoldResult result(&a, &b);
  result.setPersistentManifold(manifold_);
  ContactSink taker(manifold_ == nullptr ? nullptr : &result, first_,
                    told_overlap_m(limits::undo_pieces_m_s, step_s));
  size_t pair = 0;
  for (const CollisionHulls::Part& part_a : parts_a)
    for (const CollisionHulls::Part& part_b : parts_b) {
      NearestCorners& nearest = pair == 0 ? nearest_ : of_others_[pair - 1];
      ++pair;
      const Meeting meeting{a, b, part_a, part_b, a_from_b};
      // A pair that meets again starts without memory: whether the broadphase kept the pair must not matter.
      if (meeting.is_far())
        nearest.count = 0;
      else if (meet(meeting, nearest, taker))
        ++overlaps_;
    }
  if (manifold_ != nullptr) result.refreshContactPoints();
}

void HullAlgorithm::update_manifold(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  if (manifold_ == nullptr) {
    manifold_ = m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject());
    btManifoldResult result(&a, &b);
    result.setPersistentManifold(manifold_);
    for (const Contact& contact : first_)
      result.addContactPoint(contact.normal_on_b, contact.on_b, contact.distance_m);
    result.refreshContactPoints();
  }
  if (manifold_->getNumContacts() > 0) return;
  m_dispatcher->releaseManifold(manifold_);
  manifold_ = nullptr;
}

bool HullAlgorithm::meet(const Meeting& meeting, NearestCorners& nearest, ContactSink& to) {
  const CollisionHulls::Part &a = meeting.a, &b = meeting.b;
  const float margin_b = b.shape->getMargin();
  const float margins = a.shape->getMargin() + margin_b;
  const HullDistance found =
      distance_between(a.corners, b.corners, meeting.a_from_b, margins + limits::contact_slack_m, nearest);
  if (found.kind == HullDistance::Kind::apart) return false;
  const btTransform& at_b = meeting.object_b.getWorldTransform();
  if (found.kind == HullDistance::Kind::overlapping) {
    find_depth(*a.shape, meeting.object_a.getWorldTransform(), *b.shape, at_b, to);
    return true;
  }
  CHECK_DEBUG(is_unit(found.normal) && is_sound(found.on_b));
  const btVector3 normal = to_bullet(found.normal), on_b = to_bullet(found.on_b);
  to.addContactPoint(normal, at_b.getOrigin() + on_b + normal * margin_b, found.distance_m - margins);
  return false;
}

/// Never earlier than the tick's end: speeds are limited, so that continuous collision is not needed.
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
