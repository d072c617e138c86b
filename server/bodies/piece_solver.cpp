#include "server/bodies/piece_solver.h"

#include "server/bodies/solver_rows.h"

namespace scree {

btScalar PieceSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                                   btPersistentManifold** manifolds, int manifold_count,
                                                   btTypedConstraint** joints, int joint_count,
                                                   const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  m_resolveSingleConstraintRowGeneric = solve_between_limits;
  m_resolveSingleConstraintRowLowerLimit = solve_from_limit;
  m_resolveSplitPenetrationImpulse = undo_overlap;
  return result;
}

}  // namespace scree
