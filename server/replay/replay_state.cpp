#include "server/replay/replay_state.h"

#include <algorithm>
#include <utility>

#include "server/world/settings.h"
#include "shared/base/check.h"

namespace scree {

ReplaySource::State::State(std::unique_ptr<RecordingReader> r, RecordingHeader h)
    : reader(std::move(r)), header(std::move(h)), world(reader->path(), header.world.terrain) {}

Result<void> ReplaySource::State::restore_before(Tick wanted, BricksBefore& before) {
  auto keyframe = TRY(reader->keyframe_before(wanted, world.known()));
  KeyframeParts parts;
  if (keyframe)
    parts = std::move(*keyframe);
  else
    parts.keyframe.settings = print(header.world);
  TRY(world.restore(std::move(parts), before));
  if (world.tick() < start()) return world.damaged("the recording has no state to start from");
  return {};
}

Result<std::shared_ptr<TickDelta>> ReplaySource::State::advance(BricksBefore* before, bool undoable) {
  CHECK(world.tick() < reader->last_tick());
  auto frame = reader->frame(world.tick() + 1);
  TRY(frame);
  return world.advance(std::move(*frame), before, undoable);
}

/// Backwards from the ticks that can be taken back; else from the state there is, or a keyframe, whichever is
/// nearer. Who goes back may want to go on so: then the ticks up to there are kept.
Result<void> ReplaySource::State::go_to(Tick wanted, BricksBefore& before) {
  const bool back = wanted < world.tick();
  if (back && world.tick() - wanted <= world.undoable_ticks()) {
    while (world.tick() > wanted) world.revert_tick(before);
    return {};
  }
  const auto nearest = reader->keyframe_tick_before(wanted);
  TRY(nearest);
  if (back || *nearest > world.tick()) TRY(restore_before(wanted, before));
  while (world.tick() < wanted) TRY(advance(&before, back));
  CHECK_EQ(world.tick(), wanted);
  return {};
}

Result<bool> ReplaySource::State::begins_something(Tick at) {
  const auto frame = reader->frame(at);
  TRY(frame);
  return std::ranges::any_of(frame->operations, [](const Operation& operation) {
    return pieces_merged_by(operation) == 0 && !std::holds_alternative<DiscardOperation>(operation);
  });
}

}  // namespace scree
