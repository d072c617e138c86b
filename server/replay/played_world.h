// A world as its recorded ticks are played, without a simulation: the kernels apply the operations to a plain
// field, and the hash of every tick is compared with the recorded one. The ticks come from a recording
// (replay_source.h) or from a bus (server/told). They are not trusted: a tick that cannot be applied is an
// error, and leaves a state of which restore() alone makes use. One thread at a time.
#pragma once

#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "server/replay/brick_edits.h"
#include "server/replay/stone_history.h"
#include "server/store/keyframe_parts.h"
#include "server/world/published_state.h"
#include "server/world/spawn_place.h"
#include "server/world/stone_keeper.h"
#include "server/world/tick_delta.h"
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

/// What published ticks have told of a world, but for its bricks: jumps are told as what differs.
struct PlayedMoment {
  PieceTable pieces;
  std::map<PieceId, PublishedProp> props;
  PublishedJoints joints;
  PublishedStores stores;
  SettingValues settings;
  std::vector<PlacedStone> stones;
  std::shared_ptr<const std::vector<Region>> regions;
  std::shared_ptr<const std::vector<Sign>> signs;
};

class PlayedWorld {
 public:
  /// `name`: of what is played, for errors. `terrain`: with its ground.
  PlayedWorld(std::string name, const TerrainSource& terrain);

  /// What of the world a keyframe's reader need not read.
  KnownParts known();
  /// The world becomes a keyframe's. What that changes of the bricks is noted in `before`.
  Result<void> restore(KeyframeParts parts, BricksBefore& before);
  /// Plays the next tick. What it changes of the bricks is noted in `before`, if that is not null;
  /// `undoable`: it can be taken back.
  Result<std::shared_ptr<TickDelta>> advance(RecordedFrame frame, BricksBefore* before = nullptr,
                                             bool undoable = false);
  /// Takes back the last of the ticks that can be.
  void revert_tick(BricksBefore& before);
  /// How many can be taken back, at once.
  size_t undoable_ticks() const { return played_.size(); }

  /// Pieces, ledger and hashes as they stand.
  std::shared_ptr<TickDelta> unchanged() const;
  /// The whole state as one keyframe.
  std::shared_ptr<TickDelta> whole_state();
  PlayedMoment moment() const;
  /// Takes who has that moment's state to this one's; `before`: how bricks stood then that differ now.
  std::shared_ptr<TickDelta> differences(const PlayedMoment& from, const BricksBefore& before);

  Tick tick() const { return tick_; }
  float work_us() const { return work_us_; }  ///< of the last tick's operations, by the model
  Field& field() { return field_; }
  /// Where visitors begin as it stands now; tell_spawn() notes in a later delta when it is another place.
  Spawn spawn() {
    chosen_spawn_ = chosen_spawn(settings_);
    return spawn_place_.find(field_, chosen_spawn_);
  }
  void tell_spawn(TickDelta& delta);
  tl::unexpected<Error> damaged(const std::string& what) const;

 private:
  /// Those that lie after a tick, where the pieces and the terrain are as of it.
  void recall_stones(Tick at) {
    stones_.restart(pieces_, stone_history_.at(at), std::numeric_limits<PieceId>::max(), field_);
  }
  PlayedTick as_it_is() const;
  Result<void> apply_operation(const Operation& operation, TickDelta& delta, std::set<BrickCoord>& changed,
                               BricksBefore* before);
  Result<void> add_pieces(RecordedFrame& frame, TickDelta& delta);
  Result<void> change_props(const RecordedFrame& frame, TickDelta& delta);
  Result<void> change_joints(const RecordedFrame& frame, TickDelta& delta);
  void take_values(const RecordedFrame& frame, TickDelta& delta);
  void tell_props(TickDelta& delta) const;
  Result<void> place_pieces(const RecordedFrame& frame, TickDelta& delta);
  Result<void> check_hash(uint64_t recorded) const;

  const std::string name_;
  MapField field_;
  PieceTable pieces_;
  std::map<PieceId, QuantisedPose> poses_;
  std::map<PieceId, PublishedProp> props_;
  PublishedJoints joints_;
  std::shared_ptr<const std::vector<Region>> regions_ =
      std::make_shared<const std::vector<Region>>();  ///< never null
  std::shared_ptr<const std::vector<Sign>> signs_ =
      std::make_shared<const std::vector<Sign>>();  ///< never null
  PublishedStores stores_;
  Ledger ledger_;
  std::optional<MaterialLedger> materials_;  ///< nothing: a keyframe keeps none
  SettingValues settings_;
  uint64_t state_hash_ = 0;
  Tick tick_ = 0;
  float work_us_ = 0.0F;
  std::deque<PlayedTick> played_;  ///< the last ticks up to this one, that can be taken back
  StoneKeeper stones_;  ///< as they lie after `tick_`, of those that began in ticks that were played
  StoneHistory stone_history_;
  SpawnPlace spawn_place_;
  std::optional<Spawn> chosen_spawn_;  ///< by the settings
};

}  // namespace scree
