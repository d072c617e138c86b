#include "server/bodies/piece_solver.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <algorithm>

#include "server/bodies/hull_algorithm.h"
#include "server/bodies/limits.h"
#include "server/bodies/solver_rows.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Null for what cannot move.
const btRigidBody* moving(const btCollisionObject* object) {
  const btRigidBody* const body = btRigidBody::upcast(object);
  return body != nullptr && !body->isStaticObject() ? body : nullptr;
}

bool falls(const btRigidBody* body) {
  return body != nullptr && body->getInvMass() > 0.0F;
}

btVector3 speed_at(const btRigidBody* body, const btVector3& at) {
  if (body == nullptr) return btVector3(0.0F, 0.0F, 0.0F);
  return body->getVelocityInLocalPoint(at - body->getWorldTransform().getOrigin());
}

btVector3 along_surface(const btVector3& v, const btVector3& normal) {
  return v - normal * normal.dot(v);
}

/// Sets the direction in which a contact rubs. Bullet goes by the speed alone: what rests would be free in
/// one of two directions, and creep down a slope.
void aim_friction(const btRigidBody* a, const btRigidBody* b, const btVector3& fall_m_s,
                  btManifoldPoint& point) {
  const btVector3& normal = point.m_normalWorldOnB;
  const btVector3 falling = along_surface(fall_m_s, normal);
  btVector3 sliding = along_surface(
      speed_at(a, point.getPositionWorldOnA()) - speed_at(b, point.getPositionWorldOnB()), normal);
  if (!falls(a)) sliding -= falling;
  if (!falls(b)) sliding += falling;
  // Where two fall alike, friction alone holds the upper one back.
  if (falls(a) && falls(b) && sliding.length2() < 0.25F * falling.length2()) sliding = falling;
  const float length2 = sliding.length2();
  if (length2 > 1e-12F)
    point.m_lateralFrictionDir1 = sliding / btSqrt(length2);
  else
    btPlaneSpace1(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
  point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
}

/// By the one that resists least: a stone rolls on what it is small beside.
RollingLengths rolling_lengths(const btPersistentManifold& manifold) {
  RollingLengths least{1e30F, 1e30F};
  for (const btCollisionObject* object : {manifold.getBody0(), manifold.getBody1()}) {
    if (object->getUserPointer() == nullptr) continue;
    const RollingLengths& own = static_cast<const CollisionHulls*>(object->getUserPointer())->rolling;
    least = {std::min(least.rolling_m, own.rolling_m), std::min(least.turning_m, own.turning_m)};
  }
  return least;
}

}  // namespace

btScalar PieceSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int body_count,
                                                   btPersistentManifold** manifolds, int manifold_count,
                                                   btTypedConstraint** joints, int joint_count,
                                                   const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  m_resolveSingleConstraintRowGeneric = solve_between_limits;
  m_resolveSingleConstraintRowLowerLimit = solve_from_limit;
  m_resolveSplitPenetrationImpulse = undo_overlap;
  add_rolling_rows(manifolds, manifold_count);
  start_joints(info.m_timeStep);
  return result;
}

// The bodies that can move have their places in the pool as companion numbers.
void PieceSolver::start_joints(float step_s) {
  m_maxOverrideNumSolverIterations = joints_.empty() ? 0 : limits::joint_iterations;
  const auto solved = [&](const btRigidBody* body) {
    SolvedBody out;
    if (body == nullptr || body->isStaticObject()) return out;
    out.speed = body->getLinearVelocity();
    out.spin = body->getAngularVelocity();
    if (body->isKinematicObject()) return out;
    CHECK_DEBUG(body->getCompanionId() >= 0 && body->getCompanionId() < m_tmpSolverBodyPool.size());
    out.solver = &m_tmpSolverBodyPool[body->getCompanionId()];
    out.speed = out.solver->m_linearVelocity + out.solver->m_externalForceImpulse;
    out.spin = out.solver->m_angularVelocity + out.solver->m_externalTorqueImpulse;
    out.inverse_mass = body->getInvMass();
    out.inverse_inertia = body->getInvInertiaTensorWorld();
    return out;
  };
  for (JointRows* joint : joints_) joint->prepare(solved(joint->body_a()), solved(joint->body_b()), step_s);
  system_.begin(joints_);
}

void PieceSolver::convertContacts(btPersistentManifold** manifolds, int count,
                                  const btContactSolverInfo& info) {
  inertia_.grow(joints_, info.m_timeStep);
  for (int i = 0; i < count; ++i) {
    btPersistentManifold& manifold = *manifolds[i];
    const btRigidBody *a = moving(manifold.getBody0()), *b = moving(manifold.getBody1());
    for (int k = 0; k < manifold.getNumContacts(); ++k)
      aim_friction(a, b, fall_m_s_, manifold.getContactPoint(k));
  }
  btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
}

// The pool has the contacts of each manifold behind each other, in the order of the manifolds.
void PieceSolver::add_rolling_rows(btPersistentManifold** manifolds, int count) {
  rolling_.clear();
  const int contacts = m_tmpSolverContactConstraintPool.size();
  int next = 0;
  for (int i = 0; i < count && next < contacts; ++i) {
    btPersistentManifold& manifold = *manifolds[i];
    if (manifold.getNumContacts() == 0) continue;
    const btManifoldPoint* const begin = &manifold.getContactPoint(0);
    const int first = next;
    for (; next < contacts; ++next) {
      const auto* point =
          static_cast<const btManifoldPoint*>(m_tmpSolverContactConstraintPool[next].m_originalContactPoint);
      if (point < begin || point >= begin + manifold.getNumContacts()) break;
    }
    if (next == first) continue;
    const btSolverConstraint& row = m_tmpSolverContactConstraintPool[first];
    rolling_.emplace_back(m_tmpSolverBodyPool[row.m_solverBodyIdA], m_tmpSolverBodyPool[row.m_solverBodyIdB],
                          first, next - first, rolling_lengths(manifold));
  }
  CHECK_DEBUG(next == contacts);
}

btScalar PieceSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                           btPersistentManifold** manifolds, int manifold_count,
                                           btTypedConstraint** joints, int joint_count,
                                           const btContactSolverInfo& info, btIDebugDraw* drawer) {
  system_.iterate(iteration);
  if (!joints_.empty() && iteration > 0 && m_tmpSolverContactConstraintPool.size() == 0 && system_.is_exact())
    return 0.0F;
  const btScalar residual = btSequentialImpulseConstraintSolver::solveSingleIteration(
      iteration, bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  for (RollingRow& row : rolling_) row.solve(m_tmpSolverContactConstraintPool);
  return joints_.empty() ? residual : std::max(residual, 1.0F);  // it must not end before the joints do
}

btScalar PieceSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                                    const btContactSolverInfo& info) {
  inertia_.restore();
  for (JointRows* joint : joints_) joint->finish(info.m_timeStep);
  joints_ = {};
  return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, body_count, info);
}

}  // namespace scree
