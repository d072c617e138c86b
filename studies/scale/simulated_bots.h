// The bots of loaded_server.h in a simulation alone, without a network: what it takes by its parts, and
// whether it holds by the same measure as a server's load.
#pragma once

#include <cstdint>

#include "shared/base/result.h"
#include "studies/scale/machine_model.h"
#include "studies/scale/served_load.h"

namespace scree {

struct SimulatedBots {
  ServedLoad served;   ///< turns, carves, replies and ticks; what is a server's is 0
  SimulatedLoad load;  ///< what it took, by processor time
};

struct BotsToSimulate {
  unsigned bots = 1;
  double warm_s = 2.5;  ///< before it counts
  double seconds = 4.0;
  uint32_t random_seed = 5;
};

/// Steps on one thread. Bots take their turns as those of loaded_server.h do: one that waits for its answer
/// misses its turn. Which carves are carried out, and when, is the same on every machine, for no clock
/// decides it; stages are timed by the clock, and scaled to the thread's processor time.
SimulatedBots simulate_bots(const BotsToSimulate& what);

/// The curve of the simulation's costs, and the most bots that hold in it. The rest of SimulationCosts is of
/// a server.
Result<SimulationCosts> measure_simulation(bool quick);

}  // namespace scree
