// Bullet's solver of contacts, with rows of our own (solver_rows.h). Private to this folder.
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

namespace scree {

class PieceSolver final : public btSequentialImpulseConstraintSolver {
 protected:
  /// Bullet chooses the functions for rows here, so they are replaced afterwards.
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                        btPersistentManifold** manifolds, int manifold_count,
                                        btTypedConstraint** joints, int joint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* drawer) override;
};

}  // namespace scree
