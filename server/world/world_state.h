// The state of a world, as the stages of a tick use it. Private to this folder; others use world.h.
//
// A stage is a function of this state and of the tick's delta; World::step() calls them in order. Every
// change of the field goes through apply_and_record(), which keeps the delta, the bodies and the ledger's
// terrain consistent with it.
//
// Invariants between stages: a piece has a volume in `pieces`, a body, and traits, or none of them; a prop
// has a body; a joint is one of the bodies', too. Ids below next_piece are used up; the ledger's sum is
// right.
#pragma once

#include <map>
#include <set>

#include "server/bodies/bodies.h"
#include "server/field/vdb_field.h"
#include "server/formats/world_value.h"
#include "server/provenance/provenance.h"
#include "server/recombine/rest.h"
#include "server/work/piece_shares.h"
#include "server/work/request_queue.h"
#include "server/work/turn_queue.h"
#include "server/work/work.h"
#include "server/world/contact_sums.h"
#include "server/world/game_state.h"
#include "server/world/island_stage.h"
#include "server/world/person_blows.h"
#include "server/world/region_state.h"
#include "server/world/rules.h"
#include "server/world/spawn_place.h"
#include "server/world/stages.h"
#include "server/world/stone_keeper.h"
#include "server/world/stores.h"
#include "server/world/struck_places.h"
#include "server/world/world.h"
#include "shared/base/thread_check.h"
#include "shared/material/palette.h"
#include "shared/prop/prop_solid.h"
#include "shared/query/scene_maker.h"

namespace scree {

/// Bricks by the party that changed them; none is empty.
using BricksByParty = std::map<uint64_t, std::set<BrickCoord>>;

struct WaitingRefracture {
  PendingRefracture pending;
  float cost_us = 0.0F;
};

struct WaitingPiece {
  PieceId piece = 0;
  float cost_us = 0.0F;
};
/// Work whose price is not known before it is done.
struct WaitingWork {
  size_t index = 0;  ///< of the stage's own list
  float cost_us = 0.0F;
};

/// The parties' turns in stages that find their work anew in every tick: they remember who had how much, and
/// are empty between stages.
struct StageTurns {
  TurnQueue<WaitingPiece> merges, buried;
  TurnQueue<WaitingWork> blows, supports, slides;
};

/// A prop, with what it weighs, and the party that added it (command.h).
struct WorldProp {
  std::shared_ptr<const Prop> prop;
  uint64_t owner = 0;
  uint64_t hash = 0;  ///< of the prop, its id and its owner (state_hash.h)
};

/// A joint, and the party that added it.
struct WorldJoint {
  std::shared_ptr<const Joint> joint;
  uint64_t owner = 0;
  uint64_t hash = 0;  ///< of the joint, its id and its owner (state_hash.h)
};

struct World::State {
  State(const WorldConfig& world_config, size_t threads);

  /// Applies a valid operation, which a party (command.h) caused: falls and breaks that follow from it are
  /// that party's. Enters the terrain's gain in the ledger; the caller enters the other side. `store`: whose
  /// an operation deals with, which the caller changes afterwards.
  Applied apply_and_record(const Operation& operation, uint64_t party, TickDelta& delta,
                           const PreparedStamp* prepared = nullptr, const StoreName* store = nullptr);
  /// A search for islands begins around these bricks, as the party's.
  void loosen(uint64_t party, const std::vector<BrickCoord>& bricks);
  /// The party in whose turn work is done: by rules::as_they_come always 0, the world itself.
  uint64_t charged(uint64_t party) const { return config.rules >= rules::by_party ? party : 0; }
  /// The same of who made the piece.
  uint64_t party_of(PieceId id) const { return charged(traits_of(id).owner); }
  /// Enters the mass that an operation took out of the terrain: in pieces, and the rest in dust.
  void enter_removed(const Applied& applied);
  /// A prop has an owner, and no other traits.
  PieceTraits traits_of(PieceId id) const;
  /// Enters a valid prop, whose mass is known, without a body. Returns the shape that its body is to have.
  BodyShape enter_prop(PieceId id, std::shared_ptr<const Prop> prop, const PropMeasure& measure,
                       uint64_t owner);
  /// Takes a prop out, with its body.
  void remove_prop(PieceId id);
  /// Checks the invariants between stages. O(1).
  void check() const;
  /// Whether bricks can lie there at all: what comes from a file may say others.
  bool in_world(BrickCoord brick) const;
  /// As published with each tick (state_hash.h).
  uint64_t hash() const;
  /// The brick as it is published.
  BrickState brick_state(BrickCoord coord);
  ChunkState chunk_state(ChunkCoord chunk) const;
  /// World::measure_terrain(); `ground`: where it is known what the ground weighs.
  MassUnits measure_terrain(const GroundMasses& ground = {});
  /// The sum of the pieces' masses.
  MassUnits mass_of_pieces() const;

  WorldConfig config;                      ///< with the current settings
  std::shared_ptr<const Palette> palette;  ///< as it stands; never null
  VdbField field;
  PieceTable pieces;
  std::map<PieceId, WorldProp> props;        ///< ids are from the same numbers as pieces'
  std::map<JointId, WorldJoint> joints;      ///< ids likewise; within a tick some may have ended in `bodies`
  std::map<uint64_t, PersonRecord> persons;  ///< by session; the body of each is one of `props`
  std::map<BrickCoord, std::set<JointId>> anchors;  ///< joints by the brick of the rock that they hold
  WorldRegions regions;
  GameState game;
  Bodies bodies;                          ///< one for each of `pieces` and of `props`
  std::map<PieceId, PieceTraits> traits;  ///< one for each of `pieces`
  RestDetector rest;
  Ledger ledger;
  MaterialLedger materials;  ///< the ledger by material
  Tick tick = 0;
  PieceId next_piece = 1;
  std::set<BrickCoord> changed;   ///< in this tick
  BricksByParty loosened_bricks;  ///< changed bricks that await a search for islands
  BricksByParty strained;         ///< changed bricks that await a search for support
  BricksByParty slopes;           ///< places (slope_of) whose rubble may lie too steep
  BricksByParty unswept;          ///< changed by merges and falling islands: specks may lie there
  StruckPlaces struck;            ///< by blows that made no dent yet
  std::vector<VoxelBox> gained;   ///< around terrain that gained rock since merge_buried() looked last
  std::set<PieceId> buried;       ///< pieces in rock that await their merge
  std::set<PieceId> sunk;         ///< pieces that were in rock when merge_buried() looked last
  IslandQueue islands;
  TurnQueue<WaitingRefracture> refractures;
  Tick refractured_at = 0;  ///< tick in which one of them, or what they are parts of, was cut last
  Tick island_at = 0;       ///< tick in which an island fell last
  WorkBudget work;
  Stores stores;                          ///< the ledger has the sum of their masses
  Provenance provenance;                  ///< of mass that was broken out of regions that count
  std::optional<MassUnits> request_mass;  ///< of the request that is carried out: for its reply
  float cut_later_us = 0.0F;     ///< part of a request's price that the ticks pay in which its pieces are cut
  RequestQueue requests;         ///< that wait for a tick with room for them
  Tick requested = 0;            ///< tick in which a request that costs time was carried out last
  PieceShares shares;            ///< of the clients in `pieces`, by PieceTraits::owner
  StageTurns turns;              ///< empty between stages
  std::vector<PieceId> at_rest;  ///< pieces that become terrain in this tick
  SpawnPlace spawn_place;        ///< where visitors begin
  StoneKeeper stones;            ///< where pieces merged, for the eye; no state depends on them
  SceneMaker scenes;             ///< for questions; no tick depends on it
  PersonBlows person_blows;      ///< what moves towards persons; no state depends on it
  ContactSums contact_sums;      ///< blows between bodies that go on; no state depends on them
  bool wants_physics = false;    ///< a client wants to see the bodies
  bool wants_replaced = false;   ///< somebody remembers what bricks were
  std::vector<BrickPatch> replaced;  ///< by the operation that is applied, where they are wanted
  StageStopwatch stopwatch;          ///< of the tick's stages
  ThreadCheck thread;                ///< that of step()
};

/// Enters where pieces and props are in a tick's delta.
void publish_poses(const World::State& state, TickDelta& delta);

/// Whether bodies are a crowd, and the party has its part of them.
inline bool is_crowding(const World::State& state, uint64_t party) {
  return state.work.crowded() && !state.shares.holds_little(party);
}

/// Ticks that must lie between two falls or cuts of a kind where the next does not fit into the tick: as many
/// as pay its price by what is left of this one, and at most `rest`.
Tick wait_for_room(const World::State& state, uint64_t party, float price_us, Tick rest);

/// What all could have done in that wait, from what they could do in `rest`.
inline float part_of(float rest_us, Tick wait, Tick rest) {
  return wait < rest ? rest_us * static_cast<float>(wait) / static_cast<float>(rest) : rest_us;
}

/// Estimated work that all clients together get a second.
float client_us_per_s(const WorkBudget& work, const WorldConfig& config);

}  // namespace scree
