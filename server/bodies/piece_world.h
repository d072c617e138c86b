// Bullet's world, stepped by several threads: bounds and poses body by body, contacts in groups that do not
// touch each other (solver_groups.h), each by one thread. None reads what another changes, so the result is
// the same for any number of threads, and that of Bullet's own world. Private to this folder.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <memory>
#include <mutex>
#include <vector>

#include "server/bodies/piece_solver.h"
#include "server/bodies/solver_groups.h"
#include "shared/base/workers.h"

namespace scree {

/// Holds rigid bodies alone, without Bullet's damping, its sweeps of fast bodies and its joints.
class PieceWorld final : public btDiscreteDynamicsWorld {
 public:
  /// All arguments must outlive this object.
  PieceWorld(btDispatcher& dispatcher, btBroadphaseInterface& broadphase,
             btCollisionConfiguration& configuration, Workers& workers);
  ~PieceWorld() override;

  void updateAabbs() override;
  void solveConstraints(btContactSolverInfo& info) override;

 protected:
  /// Foresees the poses at the step's end, and the bounds that updateAabbs() hands to the broadphase.
  void predictUnconstraintMotion(btScalar step_s) override;
  void createPredictiveContacts(btScalar /*step_s*/) override {}
  void integrateTransforms(btScalar step_s) override;

 private:
  struct Moving {
    btRigidBody* body;
    btVector3 lo{0.0F, 0.0F, 0.0F};  ///< bounds at the step's start and end
    btVector3 hi{0.0F, 0.0F, 0.0F};
  };
  void solve(const SolverGroups::Group& group, const btContactSolverInfo& info);

  Workers& workers_;
  std::vector<Moving> moving_;  ///< the bodies that are awake, in Bullet's order
  SolverGroups groups_;
  std::mutex mutex_;
  /// As many as were at work at once; guarded by mutex_. A solver keeps memory from step to step, no state.
  std::vector<std::unique_ptr<PieceSolver>> idle_solvers_;
};

}  // namespace scree
