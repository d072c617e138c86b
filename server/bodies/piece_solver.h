// Bullet's solver of contacts, whose rows are solved in vector instructions: Debian's library solves them in
// scalar ones. The method is the same, sequential impulses (Catto, Iterative Dynamics with Temporal
// Coherence, 2005). Private to this folder.
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace scree {

/// One row of contacts' constraints: moves its impulse by what brings the two bodies' speed along it to the
/// wanted one, but not out of its limits. Returns the residual as Bullet counts it.
btScalar solve_between_limits(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);
/// Likewise, for a row without an upper limit.
btScalar solve_from_limit(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);
/// Likewise, of the velocities that undo overlaps, which are apart from the bodies' own.
btScalar undo_overlap(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row);

class PieceSolver final : public btSequentialImpulseConstraintSolver {
 protected:
  /// Bullet chooses the functions for rows here, so they are replaced afterwards.
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                        btPersistentManifold** manifolds, int manifold_count,
                                        btTypedConstraint** joints, int joint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* drawer) override;
};

}  // namespace scree
