// The terrain in Bullet's world: one static object that is in no broadphase, and for each body that can move
// its contacts with the ground, found in one of several ways. Private to this folder.
//
// turn() and refill() change the given bodies alone: threads may call them for different bodies at once,
// while nothing changes the terrain.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <map>
#include <memory>
#include <span>

#include "server/bodies/body.h"
#include "server/bodies/pair_dispatcher.h"
#include "server/bodies/terrain_manifold.h"
#include "server/colliders/terrain_collider.h"

namespace scree {

class TerrainBody {
 public:
  /// `field` and `dispatcher` must outlive this object.
  TerrainBody(Field& field, TerrainColliderKind kind, PairDispatcher& dispatcher,
              const TerrainSurface& surface);
  TerrainBody(const TerrainBody&) = delete;
  TerrainBody& operator=(const TerrainBody&) = delete;

  const btCollisionObject& object() const { return object_; }
  Field& field() const { return field_; }

  /// Gives a body that has its points the probe by which it finds the ground.
  void attach(Body& body) { body.probe = collider_->attach(body.points_m); }
  /// Makes the body's manifold of contacts with the ground, and releases it.
  void add_contacts(Body& body);
  void remove_contacts(Body& body);

  /// As of TerrainCollider.
  void terrain_changed(const VoxelBox& box) { collider_->terrain_changed(box); }
  /// Changes the way in which these bodies, all there are, find the terrain.
  void set_collider(TerrainColliderKind kind, std::map<PieceId, Body>& bodies);

  /// Turns the body's hulls and, if it is awake, its points. Sets Body::awake and needs_copy.
  void turn(Body& body) const;
  /// Refills the contacts of the bodies that are awake; of those that needed a copy of the terrain, or of the
  /// others.
  void refill(std::span<Body*> some, bool copying) const;
  /// Gives the contacts with the terrain the friction and restitution of its materials. One thread.
  void roughen(std::span<Body*> some, const Palette& palette) const;

 private:
  Field& field_;
  PairDispatcher& dispatcher_;
  const TerrainSurface surface_;
  btEmptyShape shape_;
  btBroadphaseProxy proxy_;
  btCollisionObject object_;
  std::unique_ptr<TerrainCollider> collider_;
};

}  // namespace scree
