// The state of a recording's world as it is played, without a simulation: the kernels apply the operations to
// a plain field. Internal to ReplaySource.
#pragma once

#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "server/replay/brick_edits.h"
#include "server/replay/event_marks.h"
#include "server/replay/recorded_cursors.h"
#include "server/replay/replay_source.h"
#include "server/replay/stone_history.h"
#include "server/world/published_state.h"
#include "server/world/spawn_place.h"
#include "server/world/stone_keeper.h"
#include "shared/operation/operation.h"

namespace scree {

/// How a tick changed the state, as far as it is needed to take the tick back.
struct PlayedTick {
  BricksBefore bricks;
  PieceTable pieces;
  std::map<PieceId, QuantisedPose> poses;
  std::map<PieceId, PublishedProp> props;
  PublishedJoints joints;
  std::shared_ptr<const std::vector<Region>> regions;
  std::shared_ptr<const std::vector<Sign>> signs;
  PublishedStores stores;
  Ledger ledger;
  std::optional<MaterialLedger> materials;
  SettingValues settings;
  uint64_t state_hash = 0;
};

struct ReplaySource::State {
  State(std::unique_ptr<RecordingReader> r, RecordingHeader h);

  /// The latest keyframe up to that tick, or the untouched terrain before tick 1; what it changes of the
  /// bricks is noted.
  Result<void> restore_before(Tick wanted, BricksBefore& before);
  /// The next tick. What it changes of the bricks is noted in `before`, if that is not null; `undoable`: it
  /// can be taken back.
  Result<std::shared_ptr<TickDelta>> advance(BricksBefore* before = nullptr, bool undoable = false);
  Result<void> go_to(Tick wanted, BricksBefore& before);
  void revert_tick(BricksBefore& before);
  /// Those that lie after a tick, where the pieces and the terrain are as of it.
  void recall_stones(Tick at) {
    stones.restart(pieces, stone_history.at(at), std::numeric_limits<PieceId>::max(), field);
  }
  std::shared_ptr<const TickDelta> whole_state();
  /// Pieces, ledger and hashes as they stand.
  std::shared_ptr<TickDelta> unchanged() const;
  Tick start() const { return reader->first_tick() - 1; }
  /// Whether an event may begin with the tick, for recordings without a log.
  Result<bool> begins_something(Tick at);

  std::unique_ptr<RecordingReader> reader;
  const RecordingHeader header;  ///< with its ground
  MapField field;
  PieceTable pieces;
  std::map<PieceId, QuantisedPose> poses;
  std::map<PieceId, PublishedProp> props;
  PublishedJoints joints;
  std::shared_ptr<const std::vector<Region>> regions =
      std::make_shared<const std::vector<Region>>();  ///< never null
  std::shared_ptr<const std::vector<Sign>> signs =
      std::make_shared<const std::vector<Sign>>();  ///< never null
  PublishedStores stores;
  Ledger ledger;
  std::optional<MaterialLedger> materials;  ///< nothing: a keyframe keeps none
  SettingValues settings;
  uint64_t state_hash = 0;
  Tick tick = 0;
  bool keyframe_due = false;      ///< next() returns the whole state
  float work_us = 0.0F;           ///< of the last tick's operations, by the model
  std::deque<PlayedTick> played;  ///< the last ticks up to this one, that can be taken back
  RecordedCursors cursors;
  EventMarks marks;
  StoneKeeper stones;  ///< as they lie after `tick`, of those that began in ticks that were played
  StoneHistory stone_history;

  /// Where visitors begin as it stands now; tell_spawn() notes in a later delta when it is another place.
  Spawn spawn() {
    chosen_spawn_ = chosen_spawn(settings);
    return spawn_place_.find(field, chosen_spawn_);
  }
  void tell_spawn(TickDelta& delta);

 private:
  Result<void> restore(KeyframeParts parts, BricksBefore& before);
  Result<void> apply_operation(const Operation& operation, TickDelta& delta, std::set<BrickCoord>& changed,
                               BricksBefore* before);
  Result<void> add_pieces(RecordedFrame& frame, TickDelta& delta);
  Result<void> change_props(const RecordedFrame& frame, TickDelta& delta);
  Result<void> change_joints(const RecordedFrame& frame, TickDelta& delta);
  void tell_props(TickDelta& delta) const;
  Result<void> place_pieces(const RecordedFrame& frame, TickDelta& delta);
  Result<void> check_hash(uint64_t recorded) const;
  tl::unexpected<Error> damaged(const std::string& what) const;

  SpawnPlace spawn_place_;
  std::optional<Spawn> chosen_spawn_;  ///< by the settings
};

}  // namespace scree
