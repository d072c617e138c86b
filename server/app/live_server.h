// A whole server in one object: ticks from the simulation or from a recording, clients, a recorder, and the
// file that keeps its world. The program scree-server adds a command line; tests and benches run the object
// in their own process. A host with rules of its own gives it hooks (LiveConfig::hooks), and pushes commands.
// It owes nothing else: the server publishes every tick, keeps it and records it.
//
// Threads: the simulation thread (unless stepped by hand), the network thread, those that help these two, a
// storage thread each for recording and world, and one that generates terrain ahead. The owner's thread calls
// all public functions, but for push(), which any thread may call.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/app/backups.h"
#include "server/app/limits.h"
#include "server/app/server_report.h"
#include "server/app/tick_feed.h"
#include "server/flight/flight_recorder.h"
#include "server/history/limits.h"
#include "server/host/host_hooks.h"
#include "server/net/net_server.h"
#include "server/store/recording_ring.h"
#include "server/store/world_saver.h"
#include "server/told/told_source.h"
#include "server/told/world_teller.h"
#include "server/world/world.h"

namespace scree {

/// real_time: at the tick rate, on a thread of its own. by_hand: by step_once() only.
enum class Pacing { real_time, by_hand };

/// What a server says of itself while it lives.
struct LivePulse {
  Tick tick = 0;
  uint32_t sessions = 0;  ///< now
  uint32_t sessions_max = 0;
  uint64_t late_ticks = 0;  ///< since the start
};

struct LiveConfig {
  WorldConfig world;       ///< a replay takes its recording's instead
  size_t sim_threads = 0;  ///< that step the bodies; 0: as many as the machine has cores
  NetConfig net;           ///< terrain, tick rate and replay are filled in
  ReplayOptions replay;    ///< plays a recording, when its path is not empty
  /// The bus by which the world is told to edges, or by which this server is one; null: none.
  std::shared_ptr<Bus> bus;
  bool bus_is_encrypted = false;
  TellerConfig tell;                 ///< of a bus: the world's name there, and what is kept
  std::shared_ptr<ToldSource> told;  ///< an edge's world; it has no other server
  std::string edge_name;             ///< an edge's name on the bus
  std::string record_path;           ///< empty: no recording
  RingLimit record_ring;             ///< how much of it is kept
  std::string events_path;  ///< file of the log of events (live_events.h), that is appended to; empty: none
  std::string
      world_path;  ///< file that keeps the world (server/store/world_file.h); empty: it ends with the server
  size_t bricks_in_max = 0;  ///< edited bricks in memory; 0: as many as the setting memory-max allows
  uint32_t history_mb =
      limits::history_mb;  ///< of the history of its edits (server/history); 0: there is none
  Durability durability = Durability::second;
  double autosave_s = 300.0;  ///< with Durability::off; 0: only at the end
  /// Limits of the machine (Setting::of_machine) that the server was told: they win over what the world that
  /// it continues has saved. `world` has them, too.
  SettingValues machine_limits;
  /// With which a kept world goes on (SavedWorld::open), and images of its rows, or of those of a new world;
  /// null: none were given. `world` has them, too.
  std::shared_ptr<const Palette> materials;
  std::shared_ptr<const ContentFiles> images;
  /// Models of props (content/files/model_folder.h); null: none, and a prop that names one is refused.
  std::shared_ptr<const ContentFiles> models;
  BackupPlan backups;                                                      ///< of the kept world
  SlowLimits slow{limits::slow_ms_default, limits::slow_save_ms_default};  ///< of the flight recorder
  std::string slow_log_path;  ///< its log of slow ticks; empty: none
  std::string trace_path;     ///< file of the trace (shared/base/trace.h); empty: none
  Pacing pacing = Pacing::real_time;
  double still_seconds = limits::still_seconds_max;  ///< without a tick: the simulation stands still
  bool governed = false;      ///< the setting work-percent follows how late ticks are (load_governor.h)
  Tick ticks_max = 0;         ///< the server ends after so many ticks; 0: never
  double seconds_max = 0.0;   ///< the server ends after so many seconds; 0: never
  uint32_t wait_clients = 0;  ///< the first tick waits until so many clients have joined
  HostHooks hooks;            ///< the host's own rules
  /// Called about each limits::pulse_seconds on the network thread, but not while the simulation stands
  /// still.
  std::function<void(const LivePulse&)> pulse;
};

/// As Linux lists the threads of a process; the bodies' helpers and the network have other threads.
inline constexpr const char* simulation_thread_name = "simulation";

class LiveServer {
 public:
  /// Listens, opens the recordings, and starts to tick.
  static Result<std::unique_ptr<LiveServer>> start(const LiveConfig& config);
  /// Calls stop().
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  uint16_t port() const;

  /// Pacing::by_hand: runs one tick; its messages are handed to the sockets when this returns. False when it
  /// was the last tick: the end of a recording that is to end there, ticks_max, or an error.
  bool step_once();

  /// Whether more ticks follow.
  bool running() const;

  /// Queues a command of the host for the next tick: with session 0, and no LeaveRequest. From any thread,
  /// but not while the server is destroyed. It waits like a client's until its terrain is in memory; its
  /// reply is in the delta. False: the server has stopped or plays a recording, or too many commands wait
  /// (limits::commands_waiting_max).
  [[nodiscard]] bool push(Command command);

  /// Reads certificate, keys and revoked tokens again (NetServer::reload).
  Result<void> reload();

  /// Changes these settings in the next tick, all or none, as a command of the server that recordings have.
  /// The log says why the world refuses them. An error: it is a replay.
  Result<void> change_settings(const SettingValues& changes);

  /// Stops ticking, tells every client, saves the world, and finishes the recording. Returns the first error
  /// since the start. A second call does nothing more.
  Result<void> stop();

  ServerReport report() const;

  /// Pacing::by_hand: the simulation, for use between steps; null for a replay.
  World* world();
  /// The result of the last tick; null before the first.
  std::shared_ptr<const TickDelta> last_delta() const;

 private:
  struct State;
  explicit LiveServer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
