#include "server/store/recording.h"

#include "shared/base/check.h"

namespace scree {

RecordedHeader to_recorded(const RecordingHeader& header) {
  RecordedHeader out = to_recorded(header.world);
  out.program = header.program;
  out.merge_burst_ticks = static_cast<uint32_t>(header.merge_burst_ticks);
  return out;
}

Result<RecordingHeader> from_recorded(const RecordedHeader& header) {
  auto world = TRY(config_of(header));
  const Tick burst = header.merge_burst_ticks;
  return RecordingHeader{header.program, std::move(world), burst == 0 ? merge_burst_ticks : burst};
}

RecordedFrame to_recorded(const TickDelta& delta, const PublishedState& before) {
  CHECK_EQ(delta.tick, before.tick() + 1);
  RecordedFrame frame;
  frame.tick = delta.tick;
  for (const AppliedOperation& applied : delta.operations) frame.operations.push_back(applied.operation);
  for (const PieceState& piece : delta.pieces) {
    const auto known = before.pieces().find(piece.id);
    if (known == before.pieces().end() || known->second.pose != piece.pose) frame.moved.push_back(piece);
  }
  frame.ledger = delta.ledger;
  frame.field_hash = delta.field_hash;
  frame.state_hash = delta.state_hash;
  frame.settings = delta.settings;
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
  keyframe.ledger = delta.ledger;
  keyframe.materials = delta.materials;
  keyframe.field_hash = delta.field_hash;
  keyframe.state_hash = delta.state_hash;
  keyframe.settings = delta.settings;
  return keyframe;
}

}  // namespace scree
