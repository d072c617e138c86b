#include "server/bodies/hull_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>

#include "server/bodies/body_shape.h"
#include "server/bodies/face_contacts.h"
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

/// None for a body that does not move.
glm::vec3 way_in_step_m(const btCollisionObjectWrapper& object, float step_s) {
  const btRigidBody* const body = btRigidBody::upcast(object.getCollisionObject());
  return body == nullptr ? glm::vec3(0.0F) : from_bullet(body->getLinearVelocity() * step_s);
}

bool is_kinematic(const btCollisionObjectWrapper& object) {
  return object.getCollisionObject()->isKinematicObject();
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
  glm::vec3 a_from_b;   ///< centre of body a relative to that of body b
  glm::vec3 of_a_m;     ///< way of body a in the step
  glm::vec3 of_b_m;     ///< and of body b
  float closing_m = 0;  ///< how far a moves to b, at most

  /// Whether the middle of one could come to the other's far side in the step.
  bool is_fast() const { return closing_m > limits::unswept_share * std::min(a.thickness_m, b.thickness_m); }
  bool is_told() const { return is_kinematic(object_a) || is_kinematic(object_b); }
  bool is_far() const {
    const glm::vec3 off = a_from_b + a.turned_m - b.turned_m;
    const float reach = a.reach_m + b.reach_m + (is_fast() ? closing_m : 0.0F) + limits::contact_slack_m;
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
    touched = true;
    normal = normal_on_b;
    if (result != nullptr)
      result->addContactPoint(normal_on_b, on_b, shallower_m);
    else
      first.push_back({normal_on_b, on_b, shallower_m});
  }

  btManifoldResult* result;  ///< null: there is no manifold yet
  std::vector<Contact>& first;
  float told_m;
  std::optional<Contact> ahead{};  ///< the nearest
  bool touched = false;            ///< since it was last set to false
  btVector3 normal{0.0F, 0.0F, 0.0F};
};

void CollisionHulls::add(const btConvexHullShape& shape) {
  const std::vector<glm::vec3> corners = corners_of(shape);
  glm::vec3 lo(1e30F), hi(-1e30F);
  for (const glm::vec3& p : corners) lo = glm::min(lo, p), hi = glm::max(hi, p);
  const glm::vec3 middle = 0.5F * (lo + hi);
  float reach2 = 0.0F;
  for (const glm::vec3& p : corners) reach2 = std::max(reach2, glm::dot(p - middle, p - middle));
  parts_.push_back({&shape, HullCorners(corners), middle, middle, std::sqrt(reach2) + shape.getMargin(),
                    thickness_of(corners, middle) + shape.getMargin()});
}

void CollisionHulls::turn(const glm::mat3& rotation) {
  for (Part& part : parts_) {
    part.corners.turn(rotation);
    part.turned_m = rotation * part.middle_m;
  }
}

void FastTouch::hold(float step_s) const {
  const auto speed = [](const btCollisionObject* object) {
    const btRigidBody* const body = btRigidBody::upcast(object);
    return body == nullptr ? btVector3(0.0F, 0.0F, 0.0F) : body->getLinearVelocity();
  };
  const float closing_m = (speed(b) - speed(a)).dot(normal_on_b) * step_s;
  if (closing_m <= unseen_m) return;
  for (const btCollisionObject* object : {a, b})
    static_cast<const CollisionHulls*>(object->getUserPointer())->stop_at(unseen_m / closing_m);
}

HullAlgorithm::~HullAlgorithm() {
  if (manifold_ != nullptr) m_dispatcher->releaseManifold(manifold_);
}

void HullAlgorithm::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                     const btDispatcherInfo& info, btManifoldResult* /*result*/) {
  find(*a, *b, info.m_timeStep);
  if (manifold_outdated()) update_manifold(*a, *b);
}

void HullAlgorithm::find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, float step_s,
                         bool in_turn) {
  const glm::vec3 a_from_b =
      from_bullet(a.getWorldTransform().getOrigin() - b.getWorldTransform().getOrigin());
  const auto &parts_a = hulls_of(a).parts(), &parts_b = hulls_of(b).parts();
  const size_t pairs = parts_a.size() * parts_b.size();
  CHECK_DEBUG(pairs > 0);
  if (of_others_.size() + 1 != pairs) of_others_.resize(pairs - 1);
  first_.clear();
  ahead_.reset();
  fast_touch_.reset();
  btManifoldResult result(&a, &b);
  result.setPersistentManifold(manifold_);
  if (!in_turn && overlaps_ > 0) {
    if (manifold_ != nullptr) result.refreshContactPoints();
    return;
  }
  overlaps_ = 0;
  ContactSink taker(manifold_ == nullptr ? nullptr : &result, first_,
                    told_overlap_m(limits::undo_pieces_m_s, step_s));
  const glm::vec3 of_a_m = way_in_step_m(a, step_s), of_b_m = way_in_step_m(b, step_s);
  const float closing_m = glm::distance(of_a_m, of_b_m);
  size_t pair = 0;
  for (const CollisionHulls::Part& part_a : parts_a)
    for (const CollisionHulls::Part& part_b : parts_b) {
      NearestCorners& nearest = pair == 0 ? nearest_ : of_others_[pair - 1];
      ++pair;
      const Meeting meeting{a, b, part_a, part_b, a_from_b, of_a_m, of_b_m, closing_m};
      // A pair that meets again starts without memory: whether the broadphase kept the pair must not matter.
      if (meeting.is_far())
        nearest.count = 0;
      else if (meet(meeting, nearest, taker))
        ++overlaps_;
      if (meeting.is_fast() && taker.touched) note_touch(meeting, taker.normal);
      taker.touched = false;
    }
  if (manifold_ != nullptr) result.refreshContactPoints();
  ahead_ = taker.ahead;
  if (manifold_ != nullptr && ahead_) add_ahead(a, b);
}

void HullAlgorithm::add_ahead(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  const btVector3 on_a = ahead_->on_b + ahead_->normal_on_b * ahead_->distance_m;
  btManifoldPoint point(a.getWorldTransform().invXform(on_a), b.getWorldTransform().invXform(ahead_->on_b),
                        ahead_->normal_on_b, ahead_->distance_m);
  point.m_positionWorldOnA = on_a;
  point.m_positionWorldOnB = ahead_->on_b;
  const btCollisionObject *of_a = a.getCollisionObject(), *of_b = b.getCollisionObject();
  point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(of_a, of_b);
  point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(of_a, of_b);
  manifold_->clearManifold();
  manifold_->addManifoldPoint(point);
}

void HullAlgorithm::update_manifold(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  if (manifold_ == nullptr) {
    manifold_ = m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject());
    btManifoldResult result(&a, &b);
    result.setPersistentManifold(manifold_);
    for (const Contact& contact : first_)
      result.addContactPoint(contact.normal_on_b, contact.on_b, contact.distance_m);
    result.refreshContactPoints();
    if (ahead_) add_ahead(a, b);
  }
  if (manifold_->getNumContacts() > 0) return;
  m_dispatcher->releaseManifold(manifold_);
  manifold_ = nullptr;
}

bool HullAlgorithm::meet(const Meeting& meeting, NearestCorners& nearest, ContactSink& to) {
  if (meeting.is_fast() && stop_at_blow(meeting, nearest, to)) return false;
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
  if (!hulls_of(meeting.object_a).meets_by_faces && !hulls_of(meeting.object_b).meets_by_faces) return false;
  for (const FaceContact& more : face_contacts(a.corners, b.corners, meeting.a_from_b, found.normal))
    if (more.distance_m < margins + limits::contact_slack_m)
      to.addContactPoint(normal, at_b.getOrigin() + to_bullet(more.on_b) + normal * margin_b,
                         more.distance_m - margins);
  return false;
}

void HullAlgorithm::note_touch(const Meeting& meeting, const btVector3& normal) {
  const float unseen_m = limits::touching_share * std::min(meeting.a.thickness_m, meeting.b.thickness_m);
  if (fast_touch_ && fast_touch_->unseen_m < unseen_m) return;
  fast_touch_ = {meeting.object_a.getCollisionObject(), meeting.object_b.getCollisionObject(), normal,
                 unseen_m};
}

// Conservative advancement: two that do not turn cannot meet before the planes across their distance do. They
// turn little in a step (limits::spin_max_rad_s).
bool HullAlgorithm::stop_at_blow(const Meeting& meeting, NearestCorners nearest, ContactSink& to) {
  constexpr int steps_max = 8;
  const float margins = meeting.a.shape->getMargin() + meeting.b.shape->getMargin();
  const glm::vec3 way_m = meeting.of_a_m - meeting.of_b_m;
  float share = 0.0F;
  glm::vec3 normal(0.0F), on_b(0.0F);
  for (int i = 0; i < steps_max; ++i) {
    const HullDistance found =
        distance_between(meeting.a.corners, meeting.b.corners, meeting.a_from_b + way_m * share,
                         margins + meeting.closing_m + limits::contact_slack_m, nearest);
    if (found.kind == HullDistance::Kind::apart) return false;
    if (found.kind == HullDistance::Kind::overlapping) {
      if (share == 0.0F) return false;
      break;
    }
    normal = found.normal, on_b = found.on_b;
    const float gap_m = found.distance_m - margins, closing_m = -glm::dot(way_m, normal);
    if (share == 0.0F && gap_m <= limits::contact_slack_m) return false;  // they touch
    if (gap_m > closing_m * (1.0F - share)) return false;
    if (gap_m < 0.25F * limits::contact_slack_m) break;
    share += gap_m / closing_m;
  }
  const float of_a_m = -glm::dot(meeting.of_a_m, normal), of_b_m = glm::dot(meeting.of_b_m, normal);
  const float least_m = 0.25F * (of_a_m + of_b_m);
  if (meeting.is_told() && (is_kinematic(meeting.object_a) ? of_a_m : of_b_m) > least_m) {
    const float ahead_m = (of_a_m + of_b_m) * share;
    if (to.ahead && to.ahead->distance_m <= ahead_m) return true;
    const btVector3 at_b = meeting.object_b.getWorldTransform().getOrigin();
    to.ahead = {to_bullet(normal), at_b + to_bullet(on_b + normal * meeting.b.shape->getMargin()), ahead_m};
    return true;
  }
  if (of_a_m > least_m) hulls_of(meeting.object_a).stop_at(share);
  if (of_b_m > least_m) hulls_of(meeting.object_b).stop_at(share);
  return true;
}

/// Never earlier than the tick's end: Bullet's own sweeps are not used.
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
