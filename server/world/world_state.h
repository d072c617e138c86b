// Everything that a world is made of, as the stages of a tick see it. Private to this folder: world.h is what
// others use.
//
// A stage is a function of this state and of the tick's delta; World::step calls them in order. Whatever
// changes the field goes through apply_and_record, which keeps the delta, the bodies and the ledger's terrain
// in step with it.
#pragma once

#include <deque>
#include <map>
#include <set>

#include "server/bodies/bodies.h"
#include "server/field/vdb_field.h"
#include "server/recombine/rest.h"
#include "server/world/island_stage.h"
#include "server/world/work.h"
#include "server/world/world.h"
#include "shared/field/material.h"

namespace scree {

/// What a piece keeps for life.
struct PieceTraits {
  uint8_t generation = 0;  ///< how often its ancestors broke
};

struct World::State {
  explicit State(const WorldConfig& world_config);

  /// Applies a valid operation; whoever calls it enters in the ledger where the mass came from or went to.
  Applied apply_and_record(const Operation& operation, TickDelta& delta,
                           const PreparedStamp* prepared = nullptr);
  /// Enters what an operation took out of the terrain: pieces, and the rest dust.
  void enter_taken(const Applied& applied);
  PieceTraits traits_of(PieceId id) const;

  WorldConfig config;
  Methods methods;  ///< as they stand; config.methods: as they were at the start
  VdbField field;
  PieceTable pieces;
  Bodies bodies;                          ///< one for each of `pieces`
  std::map<PieceId, PieceTraits> traits;  ///< of pieces that have others than the default ones
  RestDetector rest;
  Ledger ledger;
  Tick tick = 0;
  PieceId next_piece = 1;
  std::set<BrickCoord> changed;  ///< in this tick
  std::set<BrickCoord> cut;      ///< those that lost rock, which may have held something up: not searched yet
  std::set<BrickCoord> strained;  ///< those that changed, around which what holds is not searched yet
  std::set<BrickCoord> unswept;   ///< changed by merges and by islands' going: specks may lie there
  IslandQueue islands;
  WorkBudget work;
  std::deque<Command> waiting;  ///< requests that no tick had room for yet, in order
  bool watched = false;         ///< somebody wants to see the bodies
};

}  // namespace scree
