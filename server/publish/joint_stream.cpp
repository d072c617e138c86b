#include "server/publish/joint_stream.h"

#include <algorithm>

#include "proto/limits.h"

namespace scree {

namespace {

bool knows_both(const ClientView& view, const Joint& joint) {
  const auto is_known = [&](const JointSide& side) { return side.holds_terrain() || view.knows(side.body); };
  return is_known(joint.a) && is_known(joint.b);
}

/// Sends what is full, or what there is.
void flush(JointsMessage& joints, size_t least, Outlet& outlet, ServedPart& part) {
  if (std::max(joints.here.size(), joints.gone.size()) < least) return;
  outlet.send(share(joints), part);
  joints = {};
}

}  // namespace

void JointStream::serve(const ServedTick& tick, bool with_poses, const ClientView& view, Outlet& outlet,
                        ServedPart& part) {
  const PublishedJoints& joints = tick.changes.state.joints();
  const std::vector<EndedJoint>& ended = tick.changes.delta.joints_removed;
  for (const AddedJoint& added : tick.changes.delta.joints_added)
    if (!told_.contains(added.id)) untold_[added.id] = added.joint;
  if (told_.empty() && untold_.empty() && (joints.empty() || !with_poses)) return;
  if (!with_poses && ended.empty()) return;
  JointsMessage message;
  const auto is_lost = [&](const auto& told) {
    const auto& [id, joint] = told;
    const bool is_over = !joints.contains(id);
    if (!is_over && (!with_poses || knows_both(view, *joint))) return false;
    const auto why = std::ranges::lower_bound(ended, id, {}, &EndedJoint::id);
    const bool is_told = why != ended.end() && why->id == id;
    message.gone.push_back({id, is_told ? why->why : is_over ? JointEnd::removed : JointEnd::body_gone});
    flush(message, limits::joints_a_message, outlet, part);
    return true;
  };
  std::erase_if(told_, is_lost);
  if (!untold_.empty()) flush(message, 1, outlet, part);  // the ids of a message ascend
  for (const EndedJoint& end : ended) {
    const auto untold = untold_.find(end.id);
    if (untold == untold_.end()) continue;
    if (knows_both(view, *untold->second)) message.gone.push_back(end);
    untold_.erase(untold);
    flush(message, limits::joints_a_message, outlet, part);
  }
  if (with_poses) untold_.clear();
  if (with_poses)
    for (const auto& [id, joint] : joints) {
      if (outlet.room_bytes() <= 0) break;
      const auto told = told_.find(id);
      if ((told != told_.end() && told->second == joint) || !knows_both(view, *joint)) continue;
      told_[id] = joint;
      message.here.push_back({id, *joint});
      flush(message, limits::joints_a_message, outlet, part);
    }
  flush(message, 1, outlet, part);
}

}  // namespace scree
