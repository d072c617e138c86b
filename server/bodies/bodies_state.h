// What a Bodies is made of: Bullet's world, and each piece as a body in it. Private to this folder.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "server/bodies/bodies.h"
#include "server/bodies/hull_algorithm.h"
#include "server/bodies/terrain_collider.h"

namespace scree {

struct Bounds {
  btVector3 lo;
  btVector3 hi;
};

/// A piece as Bullet has it.
struct Body {
  std::unique_ptr<btConvexHullShape> shape;               ///< about all of it
  std::vector<std::unique_ptr<btConvexHullShape>> parts;  ///< what collides, where that is not `shape`
  std::unique_ptr<CollisionHulls> hulls;                  ///< of those; `rigid`'s user pointer
  std::unique_ptr<btRigidBody> rigid;
  std::vector<glm::vec3> points_m;  ///< what touches the terrain
  bool touches_by_surface = false;  ///< the points are those of its own surface, not of the hull
  std::unique_ptr<TerrainProbe> probe;
  btPersistentManifold* ground = nullptr;  ///< the dispatcher's; body 0 is `rigid`; null when frozen
  float mass_kg = 0.0F;
  btVector3 inertia_kg_m2;
  float reach_m = 0.0F;
  float spin_max_rad_s = 0.0F;
  btTransform last;                 ///< before the step: where to return to from what is no number
  std::optional<BodyState> frozen;  ///< as it stands, while it is
  std::optional<Bounds> thawed;     ///< where it stood when it thawed, until it has moved away
};

/// The piece that a Bullet object is; ids are kept in its user index, bit for bit.
inline PieceId id_of(const btCollisionObject* object) {
  return static_cast<PieceId>(object->getUserIndex());
}

struct Bodies::State {
  State(Field& field, const BodiesConfig& c);

  void find_ground(Body& body);
  void limit_speeds(Body& body) const;
  void settle(Body& body) const;
  /// Thaws what is frozen.
  void wake(Body& body);
  void wake_near(const btVector3& lo, const btVector3& hi);
  /// Into Bullet's world, and out of it; a body without mass is static there.
  void enter(Body& body);
  void leave(Body& body);
  void freeze(PieceId id, Body& body);
  /// Those that the last step struck hard, with the blow's momentum: to the solver they had no end of mass.
  void thaw_struck();
  /// What lay on a body that thawed stays until that has moved.
  void wake_around_thawed(Body& body);

  BodiesConfig config;
  Field& terrain_field;
  float voxel_size_m;
  float tick_s;
  HullAlgorithmCreator hull_algorithm;
  btDefaultCollisionConfiguration collision_configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld dynamics;
  btEmptyShape terrain_shape;
  btBroadphaseProxy terrain_proxy;
  btCollisionObject terrain;
  std::unique_ptr<TerrainCollider> terrain_collider;
  std::map<PieceId, Body> bodies;
  size_t frozen = 0;                  ///< how many of them are
  std::vector<TerrainContact> found;  ///< scratch
};

}  // namespace scree
