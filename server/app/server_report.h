// The report of a server's run, for people and programs. It grows tick by tick.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "server/app/terrain_pager.h"
#include "server/app/tick_parts.h"
#include "server/history/edit_history.h"
#include "server/metrics/durations.h"
#include "server/net/net_server.h"
#include "server/store/event_log.h"
#include "server/store/recording_ring.h"
#include "server/store/world_saver.h"
#include "server/world/tick_delta.h"

namespace scree {

/// The ticks' work by the model (server/work/work.h), and the counts of work that did not fit.
struct WorkReport {
  uint32_t budget_us = 0;
  uint32_t worst_us = 0;
  uint64_t ticks_cut_short = 0;  ///< ticks in which any work was put off or left out
  Tick first_cut_short = 0;      ///< 0: none
  Tick last_cut_short = 0;
  uint64_t ticks_merging_sooner = 0;
  uint32_t requests_waiting_most = 0;
  uint32_t refractures_put_off_most = 0;
  uint32_t merges_put_off_most = 0;
  uint64_t breaks_left_out = 0;
  uint64_t dents_left_out = 0;
  uint64_t blows_left_out = 0;
  uint32_t supports_put_off_most = 0;
  uint64_t supports_given_up = 0;
  uint32_t islands_put_off_most = 0;
  uint32_t slides_put_off_most = 0;
  uint64_t islands_too_large = 0;
  uint32_t memory_mb = 0;  ///< in the last tick

  void add(Tick tick, const TickWork& work);
};

struct ServerReport {
  uint64_t ticks = 0;  ///< stepped, or played
  Tick last_tick = 0;
  double seconds = 0.0;  ///< since the start
  OperationCounts operations;
  uint64_t pieces_made = 0;
  uint64_t pieces_merged = 0;
  uint64_t pieces_alive = 0;
  uint64_t props = 0;
  Ledger ledger;
  SettingValues settings;  ///< at the end
  uint64_t field_hash = 0;
  uint64_t state_hash = 0;
  WorkReport work;
  uint64_t late_ticks = 0;                           ///< ticks that began after their time
  uint64_t overruns = 0;                             ///< ticks of real time that were lost
  LateTicks late;                                    ///< these late ticks by their cause
  std::array<Durations, tick_stages.size()> stages;  ///< by stage, of the ticks that its row names
  StageTimes stage_sums;                             ///< of all ticks, by the clock and by the model
  TickParts part_sums;                               ///< of all ticks
  Durations model;                                   ///< of a tick, by the model of its work
  uint64_t requests_granted = 0;                     ///< that a tick answered, as the next one
  uint64_t requests_refused = 0;
  double budget_s = 0.0;  ///< of all ticks together
  TickWork last_work;     ///< of the last tick
  uint64_t persons = 0;   ///< on foot
  uint64_t kept = 0;      ///< pieces that the host's rules or directors keep
  Durations tick;
  Durations whole_tick;      ///< with all that the server does between two ticks of the world
  Durations whole_tick_cpu;  ///< of it the processor time of the simulation's thread
  Durations terrain_in,
      after_tick;            ///< of it before the world's tick, and after it: saving, terrain that goes out
  double resident_mb = 0.0;  ///< what the process has in RAM
  NetStats net;
  LatencyCounts latency;
  std::string record_path;  ///< of the recording's last part
  StoreHealth recording;
  uint64_t ticks_recorded = 0;
  uint64_t record_waits = 0;
  size_t record_waiting = 0;  ///< ticks in its queue
  Durations record_commits;
  RecordingSize record_size;
  std::string events_path;  ///< empty: no log
  EventLog::Status events;
  std::optional<HistoryStatus> history;
  std::string world_path;  ///< empty: the world ends with the server
  SaverStatus saving;
  Durations saves;
  PagerStatus paging;
  uint64_t requests_held = 0;        ///< that waited for their terrain to be read
  std::optional<std::string> error;  ///< the reason of an early end

  void add(const TickDelta& delta);
  void add(const TickParts& parts);
};

std::string to_json(const ServerReport& report);
/// Tells programs where the server listens, as one line of JSON: port, addresses and, if it serves one, the
/// page.
std::string listening_line(uint16_t port, const NetConfig& net);

}  // namespace scree
