// The solver's rows against Bullet's own, in scalar instructions.
#include "server/bodies/solver_rows.h"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

class SolverRows : public ::testing::Test {
 protected:
  float number() { return 2.0F * random_.unit() - 1.0F; }
  btVector3 vector() { return {number(), number(), number()}; }

  btSolverBody body() {
    btSolverBody made;
    made.m_originalBody = &anybody_;
    made.m_linearFactor = made.m_angularFactor = btVector3(1.0F, 1.0F, 1.0F);
    const float mass = random_.unit();
    made.internalSetInvMass({mass, mass, mass});
    made.internalGetDeltaLinearVelocity() = vector();
    made.internalGetDeltaAngularVelocity() = vector();
    made.internalGetPushVelocity() = vector();
    made.internalGetTurnVelocity() = vector();
    return made;
  }

  btSolverConstraint row() {
    btSolverConstraint made;
    made.m_contactNormal1 = vector();
    made.m_contactNormal2 = -made.m_contactNormal1;
    made.m_relpos1CrossNormal = vector();
    made.m_relpos2CrossNormal = vector();
    made.m_angularComponentA = vector();
    made.m_angularComponentB = vector();
    made.m_jacDiagABInv = 0.1F + random_.unit();
    made.m_cfm = 0.1F * random_.unit();
    made.m_rhs = number();
    made.m_rhsPenetration = random_.below(4) == 0 ? 0.0F : number();
    made.m_lowerLimit = -0.5F * random_.unit();
    made.m_upperLimit = 0.5F * random_.unit();
    made.m_appliedImpulse = 0.3F * number();
    made.m_appliedPushImpulse = 0.3F * random_.unit();
    return made;
  }

  /// A thousand random rows by both.
  void expect_alike(btSingleConstraintRowSolver ours, btSingleConstraintRowSolver bullets) {
    for (int round = 0; round < 1000; ++round) {
      btSolverBody a = body(), b = body();
      btSolverBody a_wanted = a, b_wanted = b;
      const btSolverConstraint mine = row();
      const btSolverConstraint wanted = mine;
      EXPECT_NEAR(ours(a, b, mine), bullets(a_wanted, b_wanted, wanted), 1e-4F);
      EXPECT_NEAR(mine.m_appliedImpulse, wanted.m_appliedImpulse, 1e-5F);
      EXPECT_NEAR(mine.m_appliedPushImpulse, wanted.m_appliedPushImpulse, 1e-5F);
      expect_alike(a, a_wanted);
      expect_alike(b, b_wanted);
    }
  }

 private:
  static void expect_alike(btSolverBody& mine, btSolverBody& wanted) {
    const auto off = [](const btVector3& p, const btVector3& q) { return (p - q).length(); };
    EXPECT_LT(off(mine.internalGetDeltaLinearVelocity(), wanted.internalGetDeltaLinearVelocity()), 1e-5F);
    EXPECT_LT(off(mine.internalGetDeltaAngularVelocity(), wanted.internalGetDeltaAngularVelocity()), 1e-5F);
    EXPECT_LT(off(mine.internalGetPushVelocity(), wanted.internalGetPushVelocity()), 1e-5F);
    EXPECT_LT(off(mine.internalGetTurnVelocity(), wanted.internalGetTurnVelocity()), 1e-5F);
  }

  Random random_{7};
  btRigidBody anybody_{btRigidBody::btRigidBodyConstructionInfo(1.0F, nullptr, nullptr)};
};

/// Bullet keeps these members to its subclasses.
class BulletsRows : public btSequentialImpulseConstraintSolver {
 public:
  BulletsRows() { setupSolverFunctions(false); }
  btSingleConstraintRowSolver between_limits() const { return m_resolveSingleConstraintRowGeneric; }
  btSingleConstraintRowSolver from_limit() const { return m_resolveSingleConstraintRowLowerLimit; }
  btSingleConstraintRowSolver overlap() const { return m_resolveSplitPenetrationImpulse; }
};

TEST_F(SolverRows, are_solved_as_bullet_solves_them) {
  const BulletsRows bullet;
  expect_alike(solve_between_limits, bullet.between_limits());
  expect_alike(solve_from_limit, bullet.from_limit());
  expect_alike(undo_overlap, bullet.overlap());
}

}  // namespace
}  // namespace scree
