// Bullet's collision algorithm for hull against hull, by distance_between(); where the hulls overlap by more
// than their margins, Bullet's own search finds the depth. Replaces btConvexConvexAlgorithm, which took two
// thirds of a step of 1,000 pieces.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <atomic>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "server/bodies/hull_distance.h"
#include "server/bodies/rolling_rows.h"

namespace scree {

/// The hulls of a body that collide with other bodies: one, or several of a concave piece.
class CollisionHulls {
 public:
  struct Part {
    const btConvexHullShape* shape;  ///< in the body's frame
    HullCorners corners;             ///< of the shape, turned
    glm::vec3 middle_m;              ///< middle of the bounding sphere, in the body's axes
    glm::vec3 turned_m;              ///< the same middle, in the world's axes
    float reach_m;                   ///< the bounding sphere's radius, with the margin
    float thickness_m;               ///< from its middle to its nearest face, about
  };

  /// The shape must outlive this object.
  void add(const btConvexHullShape& shape);
  void turn(const glm::mat3& rotation);
  const std::vector<Part>& parts() const { return parts_; }

  /// Part of a step by which the body moves (sweep.h): the least that anything found. Threads may stop a body
  /// at once.
  void begin_step() { step_share_ = 1.0F; }
  void stop_at(float share) const {
    float before = step_share_;
    while (share < before && !step_share_.compare_exchange_weak(before, share)) continue;
  }
  float step_share() const { return step_share_; }

  bool meets_by_faces = false;  ///< face_contacts.h finds its contacts
  RollingLengths rolling;       ///< how contacts of the body resist rolling (rolling_rows.h)

 private:
  std::vector<Part> parts_;
  mutable std::atomic<float> step_share_ = 1.0F;
};

/// Two bodies that touch and were fast before the solver. It may leave them much of their speed, because they
/// turn.
struct FastTouch {
  const btCollisionObject* a = nullptr;
  const btCollisionObject* b = nullptr;
  btVector3 normal_on_b;
  float unseen_m = 0.0F;  ///< how far they may near each other in a step

  /// Stops both where they have neared each other so far, at the speeds that they have.
  void hold(float step_s) const;
};

/// The user pointers of both objects must be their CollisionHulls, turned to their present poses. A step is
/// find(), then update_manifold(): what Bullet's processCollision() does in one.
class HullAlgorithm final : public btCollisionAlgorithm {
 public:
  using btCollisionAlgorithm::btCollisionAlgorithm;
  ~HullAlgorithm() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  /// Finds the contacts; those of a pair that has no manifold yet wait for update_manifold(). Changes this
  /// pair alone: threads may look at different pairs at once. `in_turn`: whether it seeks the depths of a
  /// pair that overlapped before; else that keeps its contacts.
  void find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, float step_s,
            bool in_turn = true);
  /// Pairs of parts that overlapped when find() looked: each takes as long as several that only touch.
  uint32_t overlaps() const { return overlaps_; }
  /// The one that find() found.
  const std::optional<FastTouch>& fast_touch() const { return fast_touch_; }
  /// Whether update_manifold() has anything to do.
  bool manifold_outdated() const {
    return manifold_ == nullptr ? !first_.empty() || ahead_ : manifold_->getNumContacts() == 0;
  }
  /// Makes the manifold for the first contacts; releases the one that has none any more.
  void update_manifold(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override;
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  struct Meeting;
  struct Contact {
    btVector3 normal_on_b;
    btVector3 on_b;
    float distance_m;
  };
  /// Hands contacts on, none deeper than `told_m`: to the manifold, or to `first_`.
  struct ContactSink;
  /// True when the two overlap by more than their margins, so that their depth had to be sought.
  static bool meet(const Meeting& meeting, NearestCorners& nearest, ContactSink& to);
  /// Stops two that strike each other on their way, where they touch. False: they do not. What moves as it
  /// was told does not stop: that contact lies ahead.
  static bool stop_at_blow(const Meeting& meeting, NearestCorners nearest, ContactSink& to);
  /// Adds the contact that lies ahead to the manifold, which must be there.
  void add_ahead(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
  void note_touch(const Meeting& meeting, const btVector3& normal);

  btPersistentManifold* manifold_ = nullptr;  ///< null while there are no contacts
  std::vector<Contact> first_;                ///< contacts found while there is no manifold
  /// Where a kinematic body strikes in the course of the step: the solver lets the other one come no nearer
  /// than that, so it is pushed before it is passed. It lasts for this step alone.
  std::optional<Contact> ahead_;
  uint32_t overlaps_ = 0;
  std::optional<FastTouch> fast_touch_;
  NearestCorners nearest_;                 ///< of the first pair of parts
  std::vector<NearestCorners> of_others_;  ///< of all other pairs of parts, in order
};

struct HullAlgorithmCreator final : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override;
};

}  // namespace scree
