// The result of one tick. Immutable once published: the publisher, the recorder and the metrics all read this
// value, and nothing else leaves the simulation.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/event.h"
#include "proto/messages.h"
#include "server/command/command.h"
#include "server/work/tick_work.h"
#include "server/world/service_limits.h"
#include "server/world/stages.h"
#include "shared/base/ids.h"
#include "shared/base/setting_value.h"
#include "shared/base/spawn.h"
#include "shared/operation/ledger.h"
#include "shared/operation/operation.h"
#include "shared/prop/joint.h"
#include "shared/recombine/settled_stone.h"
#include "shared/region/region.h"
#include "shared/region/region_mass.h"

namespace scree {

/// An applied operation, with the facts by which a publisher selects it.
struct AppliedOperation {
  Operation operation;
  std::vector<ChunkCoord> reads;   ///< chunks that apply() reads
  std::vector<ChunkCoord> writes;  ///< chunks that it changed
  std::vector<PieceId> created;
  std::optional<TickStage> stage = std::nullopt;  ///< that applied it; nothing in a replay
  /// Whose request it carries out, and the party (Command::party) that caused it, perhaps earlier. 0:
  /// nobody's, and in a replay.
  uint64_t session = 0, party = 0;
  MassUnits stored = 0;  ///< Applied::stored
};

/// A brick's state after the tick.
struct BrickState {
  BrickCoord coord;
  std::shared_ptr<const Brick> brick;
  uint64_t hash = 0;
  BrickMaterials materials{};
};

/// A brick as it was before an operation of the tick wrote it, by the operation's place in `operations`.
struct ReplacedBrick {
  size_t operation = 0;
  BrickPatch was;
};

/// A chunk's state after the tick.
struct ChunkState {
  ChunkCoord chunk;
  uint64_t hash = 0;    ///< Field::chunk_hash()
  uint64_t edited = 0;  ///< bit i: brick i of the chunk is edited
};

struct SpawnedPiece {
  PieceId id = 0;
  std::shared_ptr<const Volume> volume;
};

/// A stone where a piece merged, for the eye alone (StoneKeeper), and an edited chunk in which it lies.
struct PlacedStone {
  SettledStone stone;
  ChunkCoord chunk;
};

struct SpawnedProp {
  PieceId id = 0;
  std::shared_ptr<const Prop> prop;
};

struct AddedJoint {
  JointId id = 0;
  std::shared_ptr<const Joint> joint;
};

/// What a request that a tick carried out cost, by the model of work and on the clock. Reported only.
struct RequestCost {
  uint64_t session = 0, party = 0;  ///< 0: the server's own
  uint8_t kind = 0;                 ///< index of Request
  float price_us = 0.0F;
  float clock_us = 0.0F;
  glm::vec3 place_m{0.0F};  ///< of what it edits or acts on; the origin where it is of no place
};

struct TickDelta {
  Tick tick = 0;
  std::vector<AppliedOperation> operations;  ///< in the order in which they were applied
  std::vector<BrickState> bricks;            ///< every brick that the tick changed, ordered
  std::vector<ReplacedBrick>
      replaced;                      ///< in order of operations; empty unless wanted (World::want_replaced)
  std::vector<BrickCoord> reverted;  ///< bricks that are no longer edited, ordered: a replay jumped
  /// Every chunk that the tick changed; in a keyframe also those whose bricks are in no memory, and not among
  /// `bricks`. Empty: all chunks are in memory, and their hashes follow from `bricks`.
  std::vector<ChunkState> chunks;
  std::vector<SpawnedPiece> spawned;       ///< pieces made in this tick, ordered; some may be gone again
  std::vector<PieceState> pieces;          ///< every piece alive after the tick, ordered by id
  std::vector<PieceId> kept;               ///< those of them that are kept, ordered; none in a replay
  std::vector<PlacedStone> stones;         ///< of pieces that merged in this tick, and the rock is there
  std::vector<PlacedStone> stones_gone;    ///< there are no such stones any more
  std::vector<SpawnedProp> props_spawned;  ///< props added in this tick, ordered; some may be gone again
  std::vector<PieceState> props;           ///< every prop there is after the tick, ordered by id
  std::vector<ContactEvent> contacts;      ///< blows of bodies, the hardest first; none in a replay
  std::vector<AddedJoint> joints_added;    ///< in this tick, and whose motor changed; ordered, once each
  std::vector<EndedJoint> joints_removed;  ///< ordered; some may be among those that were added
  std::vector<Event> told;                 ///< what became of props and joints, in order; none in a replay
  std::shared_ptr<const std::vector<Region>> regions;  ///< all of them, by id, when one changed; else null
  std::vector<PersonPlace> persons;  ///< every person on foot after the tick, by session; none in a replay
  std::vector<StoreContent> stores;  ///< that changed, as they stand; ordered by owner
  /// What became of the rock of regions that count, all rows, when one changed; else null, and in a replay.
  std::shared_ptr<const std::vector<RegionMass>> region_masses;
  /// All signs, in order, when one changed; else null.
  std::shared_ptr<const std::vector<Sign>> signs;
  /// What the rules made of persons, when it changed; else null, and in a replay.
  std::shared_ptr<const std::vector<Player>> players;
  std::vector<Notice> notices;  ///< of the host's rules, in order
  std::vector<Reply> replies;
  std::vector<RequestCost> costs;  ///< of those that cost anything; none in a replay
  SettingValues settings;      ///< how every setting stands, when one changed (at first: all did); else empty
  uint64_t settings_by = 0;    ///< session that changed them; 0: the server, and in a replay
  std::optional<Spawn> spawn;  ///< where visitors begin, when that is another place than before (SpawnPlace)
  std::optional<ServiceLimits> service;       ///< those of them that are the network's; never in a recording
  std::optional<PlaybackMessage> playback;    ///< where a replay stands; of a replay alone, as the next two
  std::shared_ptr<const MarksMessage> marks;  ///< the recording's events; null: none are known
  std::shared_ptr<const RecordedCursorsMessage> cursors;  ///< of who was there; null: as in the tick before
  Ledger ledger;
  MaterialLedger materials;  ///< the same by material; empty in a replay of a recording that keeps none
  StageTimes times;
  TickWork work;
  std::shared_ptr<const PhysicsMessage> physics;  ///< null unless watched (World::watch)
  uint64_t field_hash = 0;                        ///< Field::hash()
  uint64_t state_hash = 0;                        ///< of the field, the ledger and every body's exact state
};

/// Puts the joints of a delta in order, the last state of each.
void sort_joints(TickDelta& delta);

}  // namespace scree
