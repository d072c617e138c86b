// Bullet's world, stepped by several threads: bounds and poses body by body, contacts pair by pair, and the
// solver in groups that do not touch each other (solver_groups.h), each by one thread. None reads what
// another changes, so the result is the same for any number of threads, and that of Bullet's own world.
// Private to this folder.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "server/bodies/joint_rows.h"
#include "server/bodies/pair_dispatcher.h"
#include "server/bodies/piece_solver.h"
#include "server/bodies/sleep_islands.h"
#include "server/bodies/solver_groups.h"
#include "shared/base/workers.h"

namespace scree {

/// Holds rigid bodies alone, without Bullet's damping, its sweeps of fast bodies and its joints, for which it
/// has its own (joint_rows.h). A step is
/// begin() and what follows it here, in this order, instead of Bullet's stepSimulation(). What it does not
/// touch of the bodies may be read and changed meanwhile, by other work of the same batch too.
class PieceWorld final : public btDiscreteDynamicsWorld {
 public:
  /// All arguments must outlive this object.
  PieceWorld(PairDispatcher& dispatcher, btBroadphaseInterface& broadphase,
             btCollisionConfiguration& configuration, Workers& workers);
  ~PieceWorld() override;

  void begin(float step_s);
  /// The joints from the next step on, in the order in which they are solved. They and their bodies must
  /// outlive what follows.
  void set_joints(std::vector<JointRows*> joints) { joints_ = std::move(joints); }
  /// Adds gravity, and the bounds of each body until the step's end.
  void foresee(WorkBatch& batch);
  /// Hands the bounds to the broadphase, which finds the pairs of bodies whose bounds meet: one thread's. It
  /// reads no pose and changes no contact but those of pairs that part.
  void find_pairs();
  /// Adds the search for the contacts of pairs, and for who sleeps. The hulls must be turned.
  void find_contacts(WorkBatch& batch);
  /// Also makes and releases manifolds of pairs.
  void solve();
  /// Moves a body by that share of the step, a kinematic one by all of it: one that can move. Threads may
  /// move different bodies at once.
  void move(btRigidBody& body, float share);

 private:
  struct Moving {
    btRigidBody* body;
    btVector3 lo{0.0F, 0.0F, 0.0F};  ///< bounds at the step's start and end
    btVector3 hi{0.0F, 0.0F, 0.0F};
  };
  void move_as_told(btRigidBody& body) const;
  /// Enters what is awake in groups_.
  void gather();
  void solve(const SolverGroups::Group& group);

  PairDispatcher& pairs_;
  Workers& workers_;
  float step_s_ = 0.0F;
  std::vector<JointRows*> joints_;
  std::vector<Moving> moving_;  ///< the bodies that are awake, in Bullet's order
  SleepIslands islands_;
  SolverGroups groups_;
  /// A solver keeps memory from step to step, no state.
  struct Solver {
    PieceSolver rows;
    std::vector<btPersistentManifold*> manifolds;
  };
  std::mutex mutex_;
  std::vector<std::unique_ptr<Solver>> idle_solvers_;  ///< as many as were at work at once; guarded by mutex_
};

}  // namespace scree
