// What a WorldTeller is made of. Internal to its own sources: world_teller.cpp has its calls,
// teller_thread.cpp its thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/store/keyframe_writer.h"
#include "server/told/limits.h"
#include "server/told/told_names.h"
#include "server/told/told_rows.h"
#include "server/told/world_teller.h"
#include "shared/base/log_limit.h"

namespace scree {

struct WorldTeller::State {
  struct Start {
    TickDelta keyframe;
    ReadChunk read;
  };
  struct Entry {
    std::shared_ptr<const TickDelta> delta;
    std::shared_ptr<Start> start;  ///< the world begins anew, instead of a tick
  };
  /// A keyframe on its way.
  struct Sending {
    Tick tick = 0;
    std::vector<uint8_t> bytes;
    uint32_t next = 0;      ///< number of the part
    uint64_t begins = 0;    ///< place of the first one
    uint64_t failures = 0;  ///< of the bus when it began
  };

  State(std::shared_ptr<Bus> b, const TellerConfig& c, const RecordingHeader& h, uint64_t r);

  void run();
  std::deque<Entry> take(bool& last);
  void tell(Entry& entry);
  Result<void> begin_with(Start& start);
  Result<void> tell_tick(const TickDelta& delta);
  void lose_state(const std::string& why);
  void look_at_bus();
  /// Ticks were not told: what follows makes no sense without a keyframe.
  void leave_gap(const std::string& why);
  void count_lost(uint64_t ticks);
  void count_told(size_t bytes);
  bool may_tell() const { return stream_is_open && bus->is_connected(); }
  bool is_keyframe_due(double now_s) const;
  void begin_keyframe();
  Result<void> compose_keyframe(std::vector<uint8_t>& bytes);
  void send_parts();
  Result<void> send_part();
  void finish_keyframe();
  void note(const std::optional<std::string>& because);
  double stream_bytes() const { return config.stream_mb * 1e6; }

  // Members of the thread.
  const std::shared_ptr<Bus> bus;
  const TellerConfig config;
  const ToldNames names;
  const uint64_t run_number;
  const SettingValues settings;            ///< of the header
  const std::vector<uint8_t> header;       ///< a recorded.Header
  std::unique_ptr<ToldRows> rows;          ///< null: the world is not known
  std::unique_ptr<KeyframeWriter> writer;  ///< likewise
  PublishedState published;
  std::optional<Sending> sending;
  bool stream_is_open = false;
  uint64_t connections = 0;  ///< of the bus, for which the stream is open
  uint64_t failures = 0;     ///< of the bus, that are known
  bool keyframe_is_due = true;
  bool has_changed = false;      ///< since the last keyframe
  double keyframe_s = -1.0e9;    ///< when the last one was begun
  double keyframe_took_s = 0.0;  ///< to compose
  double tail_bytes = 0.0;       ///< of ticks since
  double retry_s = 0.0;
  LogLimit log_limit;
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<Entry> queue;
  bool wants_start = true;
  bool stopping = false;
  TellerStatus status;
};

}  // namespace scree
