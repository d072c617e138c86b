#include "server/bodies/body_speeds.h"

#include <algorithm>
#include <cmath>

#include "server/bodies/limits.h"
#include "server/colliders/sound_values.h"

namespace scree {

namespace {

bool is_finite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

/// The solver moves bodies out of overlaps besides their velocity. A body that overlaps on several sides it
/// may move to and fro by far more than any one of them asks for.
void limit_undoing(Body& body, const StepSize& step) {
  btRigidBody& rigid = *body.rigid;
  btTransform now = rigid.getWorldTransform();
  const btVector3 expected =
      body.last.getOrigin() + rigid.getLinearVelocity() * (step.step_s * body.hulls->step_share());
  const btVector3 undone = now.getOrigin() - expected;
  const float most_m = limits::undo_buried_m_s * step.step_s;
  if (!(undone.length2() > most_m * most_m)) return;
  now.setOrigin(expected + undone * (most_m / undone.length()));
  rigid.setWorldTransform(now);
}

}  // namespace

void limit_speeds(Body& body) {
  btRigidBody& rigid = *body.rigid;
  const float speed = rigid.getLinearVelocity().length();
  if (const float most = speed_max_m_s(body); speed > most)
    rigid.setLinearVelocity(rigid.getLinearVelocity() * (most / speed));
  const float turning = rigid.getAngularVelocity().length();
  if (turning > body.spin_max_rad_s)
    rigid.setAngularVelocity(rigid.getAngularVelocity() * (body.spin_max_rad_s / turning));
}

// Bullet's own damping would call the math library.
void settle(Body& body, const StepSize& step, float air_drag) {
  btRigidBody& rigid = *body.rigid;
  btVector3 velocity = rigid.getLinearVelocity();
  btVector3 spin = rigid.getAngularVelocity();
  if (!is_finite(velocity) || !is_finite(spin) || !is_finite(rigid.getWorldTransform().getOrigin())) {
    rigid.setWorldTransform(body.last);
    velocity = spin = btVector3(0.0F, 0.0F, 0.0F);
  }
  limit_undoing(body, step);
  velocity *= 1.0F - step.step_s * std::min(air_drag + body.nature().drag, 1.0F);
  spin *= 1.0F - step.step_s * std::min(air_drag + body.nature().spin_drag, 1.0F);
  rigid.setLinearVelocity(velocity);
  rigid.setAngularVelocity(spin);
  limit_speeds(body);
}

bool is_sound_body(PieceId id, const Body& body) {
  const btRigidBody& rigid = *body.rigid;
  const Pose pose = pose_of(body);
  if (id_of(&rigid) != id || !is_sound(pose)) return false;
  if (body.frozen)  // it is not integrated
    return body.ground == nullptr && rigid.isStaticObject() &&
           pose.position_m == body.frozen->pose.position_m && pose.rotation == body.frozen->pose.rotation;
  return body.ground != nullptr && !rigid.isStaticObject() &&
         rigid.getLinearVelocity().length() <= speed_rounding * speed_max_m_s(body) &&
         rigid.getAngularVelocity().length() <= speed_rounding * body.spin_max_rad_s;
}

}  // namespace scree
