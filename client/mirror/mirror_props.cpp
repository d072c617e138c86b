// What a mirror knows of props, and of whatever moves.
#include <fmt/format.h>

#include "client/mirror/mirror.h"

namespace scree {

Result<void> Mirror::apply_prop(const PropMessage& message, MirrorChanges& changes) {
  if (find_moving(message.id) != nullptr)
    return fail(fmt::format("prop {} is sent a second time", message.id));
  known_motions_.add(message.id, glm::vec3(0.0F));
  const Pose pose = dequantise(message.pose);
  props_[message.id] = {{pose, pose, tick_, tick_}, std::make_shared<const Prop>(message.prop)};
  changes.props_added.push_back(message.id);
  ++counters_.props_sent;
  return {};
}

BetweenPoses* Mirror::find_moving(PieceId id) {
  if (const auto piece = motions_.find(id); piece != motions_.end()) return &piece->second;
  const auto prop = props_.find(id);
  return prop == props_.end() ? nullptr : &prop->second;
}

void Mirror::remove(PieceId id, MirrorChanges& changes) {
  const auto prop = props_.find(id);
  if (prop == props_.end()) return remove_piece(id, changes);
  forget_joints_of(id, changes);
  props_.erase(prop);
  known_motions_.remove(id);
  changes.props_removed.push_back(id);
}

}  // namespace scree
