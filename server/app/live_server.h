// A whole server in one object: ticks from the simulation or a recording, clients, and a recording on the
// side. The program scree-server is this and a command line; tests and benches run it in-process.
//
// Threads: the simulation's own (unless stepped by hand), the network's, the storage's. All public functions
// are for one thread, the owner's.
#pragma once

#include <memory>
#include <string>

#include "server/app/server_report.h"
#include "server/app/tick_feed.h"
#include "server/net/net_server.h"
#include "server/world/world.h"

namespace scree {

/// real_time: at the tick rate, on a thread of its own. by_hand: by step_once() only.
enum class Pacing { real_time, by_hand };

struct LiveConfig {
  WorldConfig world;        ///< a replay takes its recording's instead
  NetConfig net;            ///< terrain, tick rate and replay are filled in
  ReplayOptions replay;     ///< plays a recording, when its path is not empty
  std::string record_path;  ///< empty: no recording
  std::string trace_path;   ///< of what took how long (shared/base/trace.h); empty: none
  Pacing pacing = Pacing::real_time;
  Tick ticks_max = 0;         ///< ends after so many ticks; 0: does not
  double seconds_max = 0.0;   ///< ends after so many seconds; 0: does not
  uint32_t wait_clients = 0;  ///< the first tick waits until so many have joined
};

class LiveServer {
 public:
  /// Listens, opens the recordings, and starts to tick.
  static Result<std::unique_ptr<LiveServer>> start(const LiveConfig& config);
  /// Stops.
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  uint16_t port() const;

  /// Pacing::by_hand: one tick, and everything that it sends is on its way when this returns. False when
  /// there is no tick any more: the end of a recording, ticks_max, or an error.
  bool step_once();

  /// Whether ticks still come.
  bool running() const;

  /// Stops ticking, says goodbye to every client, and finishes the recording. What went wrong, if anything
  /// did. Harmless when repeated.
  Result<void> stop();

  ServerReport report() const;

  /// Pacing::by_hand: the simulation, between steps; null for a replay. The tick before, null before the
  /// first.
  World* world();
  std::shared_ptr<const TickDelta> last_delta() const;

 private:
  struct State;
  explicit LiveServer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
