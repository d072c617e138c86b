#include "server/bodies/solver_rows.h"

#include <BulletDynamics/ConstraintSolver/btSolverBody.h>
#include <BulletDynamics/ConstraintSolver/btSolverConstraint.h>
#include <algorithm>

#include "server/bodies/lanes.h"

namespace scree {

namespace {

/// A body's velocity, and what a unit of a row's impulse adds to it.
struct Side {
  btVector3& linear;
  btVector3& angular;
  Floats linear_gain;
  Floats angular_gain;

  void apply(float impulse) const {
    store(load(linear) + linear_gain * all(impulse), linear);
    store(load(angular) + angular_gain * all(impulse), angular);
  }
};

/// Speed of the two sides along a row.
float speed_along(const Side& a, const Side& b, const btSolverConstraint& row) {
  const Floats sum =
      load(row.m_contactNormal1) * load(a.linear) + load(row.m_relpos1CrossNormal) * load(a.angular) +
      load(row.m_contactNormal2) * load(b.linear) + load(row.m_relpos2CrossNormal) * load(b.angular);
  return sum[0] + sum[1] + sum[2];
}

/// Moves the row's impulse by what brings its speed to `wanted`, but not out of its limits, and returns the
/// change.
float solve(const Side& a, const Side& b, const btSolverConstraint& row, float wanted, float upper,
            btSimdScalar& applied) {
  const float before = applied;
  const float change = wanted - before * row.m_cfm - speed_along(a, b, row) * row.m_jacDiagABInv;
  applied = std::min(std::max(before + change, row.m_lowerLimit), upper);
  const float moved = applied - before;
  a.apply(moved);
  b.apply(moved);
  return moved;
}

Side side_of(btSolverBody& body, const btVector3& normal, const btVector3& angular) {
  return {body.internalGetDeltaLinearVelocity(), body.internalGetDeltaAngularVelocity(),
          load(normal) * load(body.internalGetInvMass()), load(angular)};
}

Side pushed_side_of(btSolverBody& body, const btVector3& normal, const btVector3& angular) {
  return {body.internalGetPushVelocity(), body.internalGetTurnVelocity(),
          load(normal) * load(body.internalGetInvMass()), load(angular)};
}

}  // namespace

float solve_between_limits(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row) {
  return solve(side_of(a, row.m_contactNormal1, row.m_angularComponentA),
               side_of(b, row.m_contactNormal2, row.m_angularComponentB), row, row.m_rhs, row.m_upperLimit,
               row.m_appliedImpulse) /
         row.m_jacDiagABInv;
}

float solve_from_limit(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row) {
  return solve(side_of(a, row.m_contactNormal1, row.m_angularComponentA),
               side_of(b, row.m_contactNormal2, row.m_angularComponentB), row, row.m_rhs, SIMD_INFINITY,
               row.m_appliedImpulse) /
         row.m_jacDiagABInv;
}

float undo_overlap(btSolverBody& a, btSolverBody& b, const btSolverConstraint& row) {
  if (row.m_rhsPenetration == 0.0F) return 0.0F;
  return solve(pushed_side_of(a, row.m_contactNormal1, row.m_angularComponentA),
               pushed_side_of(b, row.m_contactNormal2, row.m_angularComponentB), row, row.m_rhsPenetration,
               SIMD_INFINITY, row.m_appliedPushImpulse) /
         row.m_jacDiagABInv;
}

}  // namespace scree
