// The resistance of contacts to rolling and to turning on the spot: torques against the spin of two bodies
// about each other, of at most the contact's normal force times a small length each. So they stop what rolls
// on level ground, hold nothing on a slope that is steeper than the length over the radius, and cost a body
// that turns about an edge almost nothing. Bullet's own rows are bounded by the length alone, whatever the
// body weighs. Private to this folder.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <vector>

namespace scree {

/// By which the normal force resists rolling, and turning about the normal.
struct RollingLengths {
  float rolling_m = 0.0F;
  float turning_m = 0.0F;
};

/// Resists between two bodies that touch.
class RollingRow {
 public:
  /// `first` of the contacts of the two, and `count`, at least one; of a solver's pool. The bodies must
  /// outlive this object.
  RollingRow(btSolverBody& a, btSolverBody& b, int first, int count, const RollingLengths& lengths);

  /// Moves its impulse by what stops the spin, as far as the normal impulses allow.
  void solve(const btConstraintArray& contacts);

 private:
  btSolverBody* a_;
  btSolverBody* b_;
  int first_;
  int count_;
  RollingLengths lengths_;
  btMatrix3x3 turned_by_a_, turned_by_b_;  ///< inverses of the tensors
  btMatrix3x3 mass_;                       ///< the torque that changes the spin between the two by 1
  btVector3 applied_{0.0F, 0.0F, 0.0F};
};

}  // namespace scree
