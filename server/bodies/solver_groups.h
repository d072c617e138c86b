// What Bullet's solver solves, divided into groups that do not touch each other: bodies that contacts join,
// small ones of them together, so that a group is worth a thread's while. The groups depend on bodies and
// contacts alone, never on threads. Private to this folder.
#pragma once

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// Takes Bullet's islands, each of bodies whose bounds meet.
class SolverGroups final : public btSimulationIslandManager::IslandCallback {
 public:
  struct Group {
    std::span<btCollisionObject*> bodies;
    std::span<btPersistentManifold*> manifolds;
  };

  void clear();
  void processIsland(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                     int manifold_count, int island) override;
  /// Divides all that was taken, and returns the groups, the costliest first; within a group, bodies and
  /// manifolds keep Bullet's order. Changes the bodies' companion numbers, which the solver sets anew. Valid
  /// until clear().
  std::span<Group> divide();

 private:
  uint32_t root_of(uint32_t body);
  /// Joins the bodies of each contact.
  void join();
  /// Numbers the groups, and returns how many there are.
  uint32_t number_groups();
  uint32_t group_of(const btPersistentManifold& manifold) const;

  std::vector<btCollisionObject*> bodies_, grouped_bodies_;
  std::vector<btPersistentManifold*> manifolds_, grouped_manifolds_;
  std::vector<uint32_t> parents_;   ///< of each body, towards the first of those that it is joined with
  std::vector<uint32_t> costs_;     ///< of all bodies and contacts that are joined, at the first of them
  std::vector<uint32_t> group_of_;  ///< of each body
  std::vector<Group> groups_;
};

}  // namespace scree
