// What Bullet's solver solves, divided into groups that do not touch each other: bodies that contacts and
// joints join, small ones of them together, so that a group is worth a thread's while. The groups depend on
// bodies, contacts and joints alone, never on threads. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/bodies/disjoint_sets.h"

class btCollisionObject;
class btPersistentManifold;

namespace scree {

class JointRows;

class SolverGroups {
 public:
  /// Contacts of two bodies, of which one can move.
  struct Contacts {
    uint64_t order = 0;  ///< in which they are solved
    btPersistentManifold* manifold = nullptr;
  };
  struct Group {
    std::span<btCollisionObject*> bodies;
    std::span<Contacts> contacts;
    std::span<JointRows*> joints;
  };

  void clear();
  /// A body that can move. Sets its companion number, which the solver sets anew.
  void add(btCollisionObject& body);
  /// The bodies that can move must be added before divide().
  void add(const Contacts& contacts) { contacts_.push_back(contacts); }
  /// A joint, one of whose bodies can move and was added.
  void add(JointRows& joint) { joints_.push_back(&joint); }
  /// Divides all that was added, and returns the groups, the costliest first; within a group, bodies,
  /// contacts and joints keep their order. Valid until clear().
  std::span<Group> divide();

 private:
  /// One of the two that can move; joins both, if both can.
  uint32_t join(const btCollisionObject* a, const btCollisionObject* b);
  /// Joins the bodies of each contact and of each joint.
  void join();
  /// Numbers the groups, and returns how many there are.
  uint32_t number_groups();

  std::vector<btCollisionObject*> bodies_, grouped_bodies_;
  std::vector<Contacts> contacts_, grouped_contacts_;
  std::vector<JointRows*> joints_, grouped_joints_;
  std::vector<uint32_t> body_of_;  ///< of each of the contacts, one that can move
  std::vector<uint32_t> held_by_;  ///< the same of each of the joints
  DisjointSets joined_;            ///< of bodies
  std::vector<uint32_t> costs_;  ///< of all bodies, contacts and joints that are joined, at the first of them
  std::vector<uint32_t> group_of_;  ///< of each body
  std::vector<Group> groups_;
};

}  // namespace scree
