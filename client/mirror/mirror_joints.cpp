// What a mirror knows of joints.
#include <fmt/format.h>

#include "client/mirror/limits.h"
#include "client/mirror/mirror.h"

namespace scree {

Result<void> Mirror::apply_joints(const JointsMessage& message, MirrorChanges& changes) {
  for (const EndedJoint& gone : message.gone) forget_joint(gone, changes);
  for (const auto& [id, joint] : message.here) {
    for (const JointSide* side : {&joint.a, &joint.b})
      if (!side->holds_terrain() && find_moving(side->body) == nullptr)
        return fail(fmt::format("joint {} holds body {}, which is not known here", id, side->body));
    joints_[id] = joint;
    for (const JointSide* side : {&joint.a, &joint.b})
      if (!side->holds_terrain()) joints_of_[side->body].insert(id);
    changes.joints_changed.push_back(id);
  }
  if (joints_.size() <= limits::mirror_joints_max) return {};
  return fail(fmt::format("{} joints are over this client's {} (limits.mirror_joints_max)", joints_.size(),
                          limits::mirror_joints_max));
}

void Mirror::forget_joint(const EndedJoint& gone, MirrorChanges& changes) {
  const auto known = joints_.find(gone.id);
  if (known == joints_.end()) {  // it ended before it was told
    changes.joints_removed.push_back(gone);
    return;
  }
  for (const JointSide* side : {&known->second.a, &known->second.b}) {
    const auto of_body = joints_of_.find(side->body);
    if (of_body == joints_of_.end()) continue;
    of_body->second.erase(gone.id);
    if (of_body->second.empty()) joints_of_.erase(of_body);
  }
  joints_.erase(known);
  changes.joints_removed.push_back(gone);
}

void Mirror::forget_joints_of(PieceId body, MirrorChanges& changes) {
  for (auto of_body = joints_of_.find(body); of_body != joints_of_.end(); of_body = joints_of_.find(body))
    forget_joint({*of_body->second.begin(), JointEnd::body_gone}, changes);
}

}  // namespace scree
