#include "server/bodies/rolling_rows.h"

#include "shared/base/check.h"

namespace scree {

namespace {

/// Zero for what does not move.
btMatrix3x3 inverse_tensor(const btSolverBody& body) {
  if (body.m_originalBody == nullptr || body.internalGetInvMass().x() == 0.0F)
    return btMatrix3x3(0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F);
  return body.m_originalBody->getInvInertiaTensorWorld();
}

/// The vector, or a shorter one of that length.
btVector3 within(const btVector3& v, float most) {
  const float length2 = v.length2();
  return length2 > most * most ? v * (most / btSqrt(length2)) : v;
}

}  // namespace

RollingRow::RollingRow(btSolverBody& a, btSolverBody& b, int first, int count, const RollingLengths& lengths)
    : a_(&a),
      b_(&b),
      first_(first),
      count_(count),
      lengths_(lengths),
      turned_by_a_(inverse_tensor(a)),
      turned_by_b_(inverse_tensor(b)),
      mass_((turned_by_a_ + turned_by_b_).inverse()) {
  CHECK_DEBUG(count > 0 && lengths.rolling_m >= 0.0F && lengths.turning_m >= 0.0F);
}

void RollingRow::solve(const btConstraintArray& contacts) {
  float pressed = 0.0F;
  for (int i = first_; i < first_ + count_; ++i) pressed += contacts[i].m_appliedImpulse;
  if (pressed <= 0.0F && applied_.isZero()) return;
  const btVector3 spin = a_->m_angularVelocity + a_->internalGetDeltaAngularVelocity() -
                         b_->m_angularVelocity - b_->internalGetDeltaAngularVelocity();
  const btVector3 free = applied_ - mass_ * spin;
  const btVector3& normal = contacts[first_].m_contactNormal1;
  const btVector3 turning = normal * normal.dot(free);
  const btVector3 wanted =
      within(free - turning, lengths_.rolling_m * pressed) + within(turning, lengths_.turning_m * pressed);
  const btVector3 change = wanted - applied_;
  applied_ = wanted;
  a_->internalGetDeltaAngularVelocity() += turned_by_a_ * change;
  b_->internalGetDeltaAngularVelocity() -= turned_by_b_ * change;
}

}  // namespace scree
