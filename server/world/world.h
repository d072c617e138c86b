// The simulation: field, pieces, bodies and ledger, advanced tick by tick.
//
// A pure function of its configuration and of the commands by tick: the same input gives the same hashes, in
// any build. It reads a clock for StageTimes only. One thread calls step(); all results are in the TickDelta.
#pragma once

#include <memory>
#include <span>

#include "server/world/command.h"
#include "server/world/methods.h"
#include "server/world/tick_delta.h"
#include "shared/field/terrain.h"

namespace scree {

struct WorldConfig {
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t pieces_max = 2000;        ///< alive at once; carves beyond are refused
  uint32_t merges_per_tick_max = 8;  ///< spreads a mass settling over several ticks
  Methods methods;                   ///< to start with

  bool operator==(const WorldConfig&) const = default;
};

/// Ten times a second at 60 Hz: enough to look at, a small part of the tick.
inline constexpr Tick ticks_per_watch = 6;

class World {
 public:
  explicit World(const WorldConfig& config);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Advances one tick: commands in order, bodies, rest, recombination. The first delta says how every
  /// setting stands, later ones only when one changes.
  std::shared_ptr<const TickDelta> step(std::span<const Command> commands);

  const WorldConfig& config() const;
  const Methods& methods() const;
  Tick tick() const;
  /// The terrain's gain since the start, measured from every edited brick. Must equal the ledger's.
  MassUnits measure_terrain();
  /// Switches TickDelta::physics, in every ticks_per_watch-th delta, on or off. Changes nothing else.
  void watch(bool wanted);
  /// For reading between steps; only apply() changes it.
  Field& field();

  struct State;  ///< world_state.h, for the stages in this folder alone

 private:
  std::unique_ptr<State> state_;
};

}  // namespace scree
