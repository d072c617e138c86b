#include "server/store/recording.h"

#include <algorithm>
#include <set>

#include "shared/base/check.h"

namespace scree {

RecordedHeader to_recorded(const RecordingHeader& header) {
  RecordedHeader out = to_recorded(header.world);
  out.program = header.program;
  out.merge_burst_ticks = static_cast<uint32_t>(header.merge_burst_ticks);
  out.contacts_j = header.contacts_j;
  return out;
}

Result<RecordingHeader> from_recorded(const RecordedHeader& header) {
  auto world = TRY(config_of(header));
  const Tick burst = header.merge_burst_ticks;
  return RecordingHeader{header.program, std::move(world), burst == 0 ? merge_burst_ticks : burst,
                         header.contacts_j};
}

namespace {

/// Enters the pieces that were added, and that no operation made; some may be gone again.
void add_pieces(RecordedFrame& frame, const TickDelta& delta) {
  std::set<PieceId> made;
  for (const AppliedOperation& applied : delta.operations)
    made.insert(applied.created.begin(), applied.created.end());
  for (const SpawnedPiece& piece : delta.spawned)
    if (!made.contains(piece.id)) frame.pieces.push_back({piece.id, *piece.volume, {}});
}

/// Enters the props that were added and that still are there, where others went, and which are gone.
void add_props(RecordedFrame& frame, const TickDelta& delta, const PublishedState& before) {
  auto known = before.props().begin();
  for (const PieceState& prop : delta.props) {
    while (known != before.props().end() && known->first < prop.id)
      frame.props_gone.push_back((known++)->first);
    if (known == before.props().end() || known->first != prop.id) {
      const auto made = std::ranges::lower_bound(delta.props_spawned, prop.id, {}, &SpawnedProp::id);
      CHECK(made != delta.props_spawned.end() && made->id == prop.id);
      frame.props.push_back({prop.id, *made->prop, prop.pose});
      continue;
    }
    if (known->second.pose != prop.pose) frame.moved.push_back(prop);
    ++known;
  }
  for (; known != before.props().end(); ++known) frame.props_gone.push_back(known->first);
}

std::vector<PropMessage> props_of(const TickDelta& keyframe) {
  CHECK_EQ(keyframe.props_spawned.size(), keyframe.props.size());
  std::vector<PropMessage> props;
  for (size_t i = 0; i < keyframe.props.size(); ++i)
    props.push_back({keyframe.props[i].id, *keyframe.props_spawned[i].prop, keyframe.props[i].pose});
  return props;
}

/// Enters the joints that changed and still are, and those that were there before and ended.
void add_joints(RecordedFrame& frame, const TickDelta& delta, const PublishedState& before) {
  const auto has_ended = [&](JointId id) {
    return std::ranges::binary_search(delta.joints_removed, id, {}, &EndedJoint::id);
  };
  for (const AddedJoint& added : delta.joints_added)
    if (!has_ended(added.id)) frame.joints.here.push_back({added.id, *added.joint});
  for (const EndedJoint& ended : delta.joints_removed)
    if (before.joints().contains(ended.id)) frame.joints.gone.push_back(ended);
}

}  // namespace

RecordedFrame to_recorded(const TickDelta& delta, const PublishedState& before) {
  CHECK_EQ(delta.tick, before.tick() + 1);
  RecordedFrame frame;
  frame.tick = delta.tick;
  for (const AppliedOperation& applied : delta.operations) frame.operations.push_back(applied.operation);
  for (const PieceState& piece : delta.pieces) {
    const auto known = before.pieces().find(piece.id);
    if (known == before.pieces().end() || known->second.pose != piece.pose) frame.moved.push_back(piece);
  }
  add_pieces(frame, delta);
  add_props(frame, delta, before);
  add_joints(frame, delta, before);
  frame.stores = delta.stores;
  std::ranges::sort(frame.moved, {}, &PieceState::id);
  frame.ledger = delta.ledger;
  frame.field_hash = delta.field_hash;
  frame.state_hash = delta.state_hash;
  frame.settings = delta.settings;
  frame.regions = delta.regions;
  frame.signs = delta.signs;
  frame.notices = delta.notices;
  return frame;
}

RecordedKeyframe to_recorded_keyframe(const TickDelta& delta) {
  CHECK(delta.operations.empty());
  CHECK_EQ(delta.spawned.size(), delta.pieces.size());
  RecordedKeyframe keyframe;
  keyframe.tick = delta.tick;
  for (const BrickState& state : delta.bricks)
    keyframe.bricks.push_back({state.coord, *state.brick, state.materials});
  for (size_t i = 0; i < delta.spawned.size(); ++i) {
    CHECK_DEBUG(delta.spawned[i].id == delta.pieces[i].id);
    keyframe.pieces.push_back({delta.spawned[i].id, *delta.spawned[i].volume, delta.pieces[i].pose});
  }
  keyframe.props = props_of(delta);
  for (const AddedJoint& added : delta.joints_added) keyframe.joints.push_back({added.id, *added.joint});
  keyframe.stores = delta.stores;
  keyframe.ledger = delta.ledger;
  keyframe.materials = delta.materials;
  keyframe.field_hash = delta.field_hash;
  keyframe.state_hash = delta.state_hash;
  keyframe.settings = delta.settings;
  if (delta.regions != nullptr) keyframe.regions = *delta.regions;
  if (delta.signs != nullptr) keyframe.signs = *delta.signs;
  return keyframe;
}

}  // namespace scree
