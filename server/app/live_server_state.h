// What a LiveServer is made of: for its own sources, which open it (live_server_open.cpp), run it
// (live_server.cpp) and let its host decide (live_server_host.cpp).
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/app/admission.h"
#include "server/app/audit_trail.h"
#include "server/app/figure_hour.h"
#include "server/app/heartbeat.h"
#include "server/app/live_events.h"
#include "server/app/live_server.h"
#include "server/app/load_governor.h"
#include "server/app/piece_forecast.h"
#include "server/app/resident_memory.h"
#include "server/app/save_delay.h"
#include "server/app/saved_world.h"
#include "server/app/terrain_ahead.h"
#include "server/app/terrain_pager.h"
#include "server/app/tick_parts.h"
#include "server/app/tick_schedule.h"
#include "server/app/tick_trace.h"
#include "server/app/tick_watch.h"
#include "server/history/edit_history.h"
#include "server/store/recorder.h"
#include "server/told/edge_pipes.h"
#include "server/told/pipe_door.h"
#include "shared/base/log_limit.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

struct LiveServer::State {
  using Clock = std::chrono::steady_clock;
  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  explicit State(const LiveConfig& c) : config(c), heartbeat(steady_now_s(), c.still_seconds) {}

  Result<void> open();
  Result<void> open_world();
  Result<void> open_replay(std::optional<Spawn>& spawn);
  Result<void> open_edge();
  Result<void> open_bus();
  void tell_bus(const std::shared_ptr<const TickDelta>& delta);
  void check_bus(double now_s) const;
  void add_bus_faults(ServerHealth& found) const;
  std::vector<Figure> figures_beside() const;
  Result<void> open_recorder();
  Result<void> open_events();
  Result<void> open_history();
  Result<void> open_records();
  void tell_memory_limit() const;
  std::vector<std::string> lines(LinesOf of) const;
  std::vector<std::string> setting_lines() const;
  void sample_figures(double now_s);
  void forget_history();
  void pass_on_hooks();
  void answer_history(uint64_t session, uint32_t request, const HistoryAct& asked, const std::string& who);
  Result<void> open_flight();
  void end_old_sessions(const TickDelta& keyframe);
  ServerReport report_now(const NetStats& stats, const LatencyCounts& latency) const;
  /// On the network thread.
  std::string status(const NetFigures& figures) const;
  std::string metrics(const NetFigures& figures) const;
  Saving saving() const;
  ServerHealth health() const;
  void check_heartbeat(double now_s);
  void send_pulse(double now_s);
  void tell();
  std::shared_ptr<const TickDelta> save_and_filter(std::shared_ptr<const TickDelta> delta,
                                                   std::vector<Reply> refused);
  Result<void> start_saving();
  void run();
  bool step();
  std::optional<Admitted> next_commands();
  HostActs host_acts();
  bool ask_host(const World& world, Admitted& admitted);
  /// Adds those that the next tick changes by itself. Whether somebody chooses work-percent.
  bool add_settings(std::vector<Command>& commands);
  void tell_settings(const TickDelta& delta) const;
  void refuse_missing_models(Admitted& admitted);
  bool wait_for_clients();
  bool time_is_over() const {
    return config.seconds_max > 0.0 && Clock::now() >= started + seconds(config.seconds_max);
  }
  std::shared_ptr<const WorldMoment> begin_part(const TickDelta& delta);
  void record(std::shared_ptr<const TickDelta> delta, std::vector<Command> carried_out,
              std::vector<Event> noted);
  void tell_recording();
  /// Notes nothing where nobody wants to know.
  bool has_events() const { return !config.events_path.empty() || !config.record_path.empty(); }
  void count(TickSchedule::Delay delay);
  void govern(double length, TickSchedule::Delay delay);
  bool sleep_until(Clock::time_point when);
  void end(const std::string& error);
  /// Writes the rest of all files, and closes them; once.
  void finish_files();

  LiveConfig config;
  CommandQueue commands;
  std::unique_ptr<TickFeed> feed;      ///< used by the simulation thread only, but for control()
  std::unique_ptr<LiveEvents> events;  ///< null: nobody wants to know
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<SavedWorld> saved_world;   ///< null: a replay
  std::unique_ptr<EditHistory> history;      ///< likewise, or none is kept
  std::unique_ptr<Backups> backups;          ///< null: none are made
  std::unique_ptr<TerrainPager> pager;       ///< likewise, of a replay
  std::unique_ptr<ResidentMemory> resident;  ///< likewise
  PieceForecast forecast;
  Admission admission;
  std::unique_ptr<LoadGovernor> governor;     ///< null: a replay, or not wanted
  std::optional<uint32_t> work_percent_next;  ///< the governor's wish, for the next tick
  SettingValues limits_to_set;  ///< in the first tick: the machine's, which win over a kept world's
  std::unique_ptr<FlightRecorder> flight;
  TickWatch watch;                         ///< used by the simulation thread only, as the next
  std::optional<Clock::time_point> due{};  ///< of the next tick; nothing: by hand
  std::shared_ptr<EdgePipes> edge_pipes;   ///< null: this is no edge
  std::unique_ptr<WorldTeller> teller;     ///< null: the world is not told
  std::unique_ptr<NetServer> net;
  std::unique_ptr<PipeDoor> pipe_door;        ///< null: the world is not told
  std::unique_ptr<BusSubscription> edge_ear;  ///< of edge_pipes
  std::unique_ptr<TerrainAhead> ahead;        ///< null: a recording's ticks need no terrain
  std::unique_ptr<Trace> trace;               ///< null: no trace
  std::thread thread;
  Heartbeat heartbeat;      ///< of the simulation's thread
  double pulse_at_s = 0.0;  ///< when the next pulse is due; used by the network thread only, as the next two
  std::unique_ptr<AuditTrail> audit;
  FigureHour figure_hour;
  Clock::time_point started = Clock::now();
  const uint64_t started_unix_s = unix_now_ms() / 1000;
  Clock::duration period{};
  TickParts parts;                              ///< of the last tick; used by the simulation thread only
  LogLimit log_limit;                           ///< used by the simulation thread only, as the next two
  std::optional<std::string> record_complaint;  ///< the last that was logged
  bool ring_told = false;                       ///< that it is over its limit
  bool finished = false;                        ///< its files; used by the owner's thread only

  const std::shared_ptr<ChunkFetcher> for_clients = std::make_shared<ChunkFetcher>();
  uint64_t read_before = 0;  ///< chunks, until the last second began; used by the simulation thread only
  uint32_t read_last_second = 0;
  bool broken = false;  ///< the world does not stand between two ticks; used as finished is

  std::atomic<bool> is_open = false;  ///< all that status() looks at is there

  mutable std::mutex mutex;  ///< guards the members below
  Saving told;
  SaveDelay save_delay;
  std::condition_variable changed;
  SettingValues settings_told;  ///< for the next tick: change_settings()
  bool stopping = false;
  bool running = true;
  ServerReport report;
  double worst_tick_ms = 0.0;  ///< since the last sample of figures
  std::shared_ptr<const TickDelta> last_delta;
};

}  // namespace scree
