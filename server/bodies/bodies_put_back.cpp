// Bodies that a region does not let in.
#include "server/bodies/bodies_state.h"
#include "shared/base/check.h"

namespace scree {

void Bodies::put_back(PieceId id, const Pose& pose, glm::vec3 velocity_m_s) {
  State& s = *state_;
  BodyState now = state(id);
  now.pose = pose;
  now.velocity_m_s = velocity_m_s;
  now.frozen = false;
  const std::shared_ptr<const BodyShape> given = s.bodies.at(id).given;
  CHECK(!s.bodies.at(id).is_fixed());
  s.leave_joints(id);
  s.take_out(id);
  add(*given, now);
  s.enter_joints(id);
}

}  // namespace scree
