// What a machine of some cores holds: processor time by load and by thread, measured on one core, and the
// limits that a load meets. Pure functions.
//
// A load is a number of bots, of which each carves at a steady rate and looks on, and of viewers that only
// look on. A server's processor time has two parts:
// - The simulation's thread. What it takes by number of bots is a curve, not a line: when bodies fill the
//   budget of a tick (server/work/work.h), carves get fewer pieces and these merge sooner, so that more bots
//   take little more. The curve is that of a simulation alone, times a factor for what the thread takes more
//   within a server. All cores share the bodies' step; the rest is one thread's.
// - All other threads, which share any number of cores: idle + a·bots + b·onlookers + c·bots·onlookers, where
//   bots and viewers look on. The terms are the server's work for nobody, the storing and encoding of a bot's
//   carves, an onlooker's cost whatever happens, and the cost of showing him a bot's carves.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace scree {

struct MachineLoad {
  double bots = 0.0;
  double viewers = 0.0;

  double onlookers() const { return bots + viewers; }
};

/// Milliseconds of processor time in a second.
struct LoadCosts {
  double idle = 0.0;
  double bot = 0.0;
  double onlooker = 0.0;
  double shown = 0.0;  ///< a bot's doing to an onlooker

  double of(const MachineLoad& load) const {
    return idle + bot * load.bots + (onlooker + shown * load.bots) * load.onlookers();
  }
};

struct MeasuredLoad {
  MachineLoad load;
  double ms_per_s = 0.0;  ///< positive
};

/// Least squares of the relative errors, without negative costs: a term that would be negative is left out.
/// Nothing when the loads do not tell the terms apart.
std::optional<LoadCosts> fit_load_costs(std::span<const MeasuredLoad> measured);

/// Root of the mean square of measured / fitted - 1.
double relative_error(std::span<const MeasuredLoad> measured,
                      const std::function<double(const MachineLoad&)>& fitted);

/// What the simulation alone takes for so many bots, in milliseconds a second on one thread.
struct SimulatedLoad {
  double bots = 0.0;
  double serial_ms_s = 0.0;   ///< by the simulation's thread alone
  double shared_ms_s = 0.0;   ///< that threads share: the bodies' step
  double pieces_alive = 0.0;  ///< on average

  double ms_s() const { return serial_ms_s + shared_ms_s; }
};

struct SimulationCosts {
  std::vector<SimulatedLoad> loads;  ///< with rising bots, more than none; at least one
  double in_server = 1.0;            ///< what its thread takes in a server, over what it takes alone
  double idle_ms_s = 0.0;            ///< of that thread, with nobody there
  /// That the simulation itself carries out in time, on any machine: more than that, and `work-percent` and
  /// `pieces-max` make requests wait or be refused.
  double bots_most = 1e7;

  /// Alone: on the line between the measured loads beside it, from nothing for none; above the largest as
  /// that.
  SimulatedLoad at(double bots) const;
};

/// Limits of a server and of its machine.
struct MachineLimits {
  double cores = 1.0;
  double usable = 1.0;      ///< share of the processors' time that may be taken, so that ticks are in time
  double memory_mib = 1e9;  ///< for the server
  double mbit_s = 1e9;      ///< that it may send
};

/// What else a load takes.
struct LoadSizes {
  double mib = 0.0;  ///< of the server without anybody
  double mib_onlooker = 0.0;
  double kbit_s_shown = 0.0;  ///< sent to an onlooker, for each bot
};

enum class MachineLimit { processors, simulation_thread, work, memory, bandwidth };
std::string_view name_of(MachineLimit limit);

struct Held {
  double most = 0.0;  ///< of what is asked for
  MachineLimit limit = MachineLimit::processors;
};

/// All that is known of a server, in which clients' costs are added to the others where they share its
/// processors.
struct MachineModel {
  SimulationCosts simulation;
  LoadCosts others;  ///< of all threads but the simulation's
  LoadSizes sizes;

  /// Processor time of all threads, and of the simulation's where it has so many cores to share its bodies.
  double ms_s(const MachineLoad& load) const;
  double simulation_thread_ms_s(double bots, double cores) const;

  /// Share of the limit that the load takes; more than 1: it does not hold.
  double share(MachineLimit limit, const MachineLoad& load, const MachineLimits& limits) const;
  /// Most bots beside so many viewers, and most viewers beside so many bots; not negative.
  Held bots_held(double viewers, const MachineLimits& limits) const;
  Held viewers_held(double bots, const MachineLimits& limits) const;
};

}  // namespace scree
