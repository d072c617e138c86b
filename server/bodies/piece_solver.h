// Bullet's solver of contacts, with rows of our own (solver_rows.h, rolling_rows.h, joint_rows.h). Private to
// this folder.
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <span>
#include <vector>

#include "server/bodies/joint_system.h"
#include "server/bodies/rolling_rows.h"

namespace scree {

/// Contacts rub against the motion that would be without them.
class PieceSolver final : public btSequentialImpulseConstraintSolver {
 public:
  /// What gravity adds to the speed of bodies in a step.
  void set_fall(const btVector3& fall_m_s) { fall_m_s_ = fall_m_s; }
  /// The joints of the next group; valid until it is solved.
  void set_joints(std::span<JointRows*> joints) { joints_ = joints; }

 protected:
  /// Bullet chooses the functions for rows here, so they are replaced afterwards.
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                        btPersistentManifold** manifolds, int manifold_count,
                                        btTypedConstraint** joints, int joint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** manifolds, int manifold_count,
                                btTypedConstraint** joints, int joint_count, const btContactSolverInfo& info,
                                btIDebugDraw* drawer) override;

  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                         const btContactSolverInfo& info) override;

 private:
  void start_joints(float step_s);
  void add_rolling_rows(btPersistentManifold** manifolds, int count);

  btVector3 fall_m_s_{0.0F, 0.0F, 0.0F};
  std::span<JointRows*> joints_;
  JointSystem system_;
  HeldInertia inertia_;
  std::vector<RollingRow> rolling_;
};

}  // namespace scree
