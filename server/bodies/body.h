// A piece or a prop as a rigid body of Bullet. Private to this folder.
//
// Invariant: a body is frozen, or has a terrain manifold, never both. A fixed prop is always frozen.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "server/bodies/bodies.h"
#include "server/bodies/hull_algorithm.h"
#include "server/bodies/round_body.h"
#include "server/bodies/to_bullet.h"
#include "server/colliders/terrain_collider.h"

namespace scree {

struct Bounds {
  btVector3 lo;
  btVector3 hi;
};

/// A piece as a rigid body of Bullet, in its principal axes: Bullet's tensors are diagonal. Hulls and points
/// are turned into these axes; poses that come and go are in the volume's.
struct Body {
  std::shared_ptr<const BodyShape> given;                 ///< in the volume's axes
  glm::quat axes{1.0F, 0.0F, 0.0F, 0.0F};                 ///< from the principal axes to the volume's
  std::unique_ptr<btConvexHullShape> shape;               ///< the hull of the whole piece
  std::vector<std::unique_ptr<btConvexHullShape>> parts;  ///< colliding parts; empty: `shape` collides
  std::unique_ptr<CollisionHulls> hulls;                  ///< of the colliding shapes; `rigid`'s user pointer
  std::unique_ptr<btRigidBody> rigid;
  std::vector<glm::vec3> points_m;  ///< points that collide with the terrain
  Roundness round;
  bool touches_by_surface = false;  ///< the points are those of its own surface, not of the hull
  std::unique_ptr<TerrainProbe> probe;
  /// Contacts with the terrain; owned by the dispatcher; body 0 is `rigid`. Null while frozen.
  btPersistentManifold* ground = nullptr;
  glm::vec3 rubs_at_m{0.0F};  ///< place whose material those contacts are with
  float mass_kg = 0.0F;
  btVector3 inertia_kg_m2;  ///< principal moments
  float reach_m = 0.0F;
  float spin_max_rad_s = 0.0F;
  bool awake = false;                        ///< within a step: at its start; it may touch the terrain
  bool roused = false;                       ///< within tell_changes(): it wakes
  bool needs_copy = false;                   ///< within a step: its probe must copy the terrain first
  btVector3 speed_before{0.0F, 0.0F, 0.0F};  ///< at the step's start, of the centre of mass; as the spin
  btVector3 spin_before{0.0F, 0.0F, 0.0F};
  bool sinks = false;   ///< most points of a prop lay deep in the terrain when they were last compared
  bool looked = false;  ///< for the way out of the terrain, since it sank there
  std::optional<glm::vec3> way_out;  ///< direction to the nearest free place; nothing: there is none, or it
                                     ///< is not known yet
  btTransform last;                  ///< transform before the step: restored when the step's is not finite
  std::optional<BodyState> frozen;   ///< the state of a frozen body
  std::optional<Bounds> thawed;      ///< bounds at its thawing, until it has moved away from them

  /// How fast a place of it, so far from its centre of mass, moved at the step's start.
  btVector3 speed_before_at(const btVector3& arm) const { return speed_before + spin_before.cross(arm); }
  const BodyNature& nature() const { return given->nature; }
  /// Whether contacts and gravity move it, once it is not frozen.
  bool is_dynamic() const { return nature().motion == PropMotion::dynamic; }
  bool is_kinematic() const { return nature().motion == PropMotion::kinematic; }
  bool is_fixed() const { return nature().motion == PropMotion::fixed; }
  bool meets_terrain() const { return is_dynamic() && (nature().meets & group::terrain) != 0; }
};

/// The piece's pose.
inline Pose pose_of(const Body& body) {
  Pose pose = from_bullet(body.rigid->getWorldTransform());
  pose.rotation = pose.rotation * glm::conjugate(body.axes);
  return pose;
}

/// Moves the contacts of a round body to where it touches the ground.
inline void touch_as_round(const Body& body, std::vector<TerrainContact>& contacts) {
  const auto points = static_cast<int>(body.points_m.size());
  const btMatrix3x3& basis = body.rigid->getWorldTransform().getBasis();
  if (body.round.is_roller())
    touch_as_roller(body.round, from_bullet(basis * to_bullet(body.round.half_axis_m)), points, contacts);
  else if (body.round.radius_m > 0.0F)
    touch_as_ball(body.round, points, contacts);
}

/// The piece of a Bullet object: its user index holds the id, bit for bit.
inline PieceId id_of(const btCollisionObject* object) {
  return static_cast<PieceId>(object->getUserIndex());
}

inline bool meet(const Bounds& a, const Bounds& b) {
  return TestAabbAgainstAabb2(a.lo, a.hi, b.lo, b.hi);
}

inline Bounds bounds_of(const Body& body) {
  Bounds bounds;
  body.rigid->getAabb(bounds.lo, bounds.hi);
  return bounds;
}

}  // namespace scree
